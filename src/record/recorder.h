// Records a run: everything on the bus, what only the simulation knows, and what happened.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/spsc_ring.h"
#include "bus/cdr.h"
#include "bus/discovery.h"
#include "emulator/event_table.h"
#include "emulator/status.h"
#include "record/mcap_writer.h"
#include "record/truth.h"

namespace understudy::record {

// What a file says of its run before the first message.
struct RecordingHead {
  StringMap about;     // metadata "understudy"
  std::string config;  // attachment config.yaml
  std::string model;   // attachment model.mjb
};

// A robot between two steps, as the loop offers it.
struct Moment {
  std::int64_t wall = 0;  // ns, CLOCK_MONOTONIC, of the offer
  Truth truth;
};

// Of a burst of events each cause is told once in this simulated time [s]; *assumed*.
inline constexpr double kEventEvery = 0.1;

// One thread of its own takes, as bytes, what anybody writes to the topics of the bus (those that
// our participant has, and others as they are discovered), and merges it with what the loop offers
// into one file in order of time.
//
// Every message gets the simulated time of the tick in which it was sent, or could first be taken:
// log_time is the wall time of the start, a whole number of ns, plus simulated time.
class Recorder {
 public:
  // Logs: a line, and whether it is an error.
  using Say = std::function<void(const std::string& line, bool error)>;

  // Writes the file's beginning and starts the thread. Topics that `participant` has by now are
  // recorded from their first message on. `events` outlives the recorder. `moment` has vectors of
  // the sizes that will be offered. Throws RecordError and BusError.
  Recorder(const bus::Participant& participant, OutputFile file, const RecordingHead& head,
           const emulator::EventRing* events, const Moment& moment,
           std::chrono::nanoseconds timestep, Say say);
  // Takes what is left and finishes the file.
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  // The loop's thread. None of these waits or allocates.
  //
  // After every tick: `step` was made, and whatever it sent has been sent.
  void Mark(std::int64_t step);
  // Room for what is to be offered, to be filled and committed, or nullptr when the recording has
  // failed, or, counted as dropped, when its thread is far behind.
  Moment* Claim();
  void Commit();
  // The thread is so far behind that the loop should give it time if it has any to give.
  bool behind() const;

  // Any thread.
  emulator::RecordingStatus status() const;

 private:
  using Nanoseconds = std::int64_t;
  struct StepMark {
    Nanoseconds wall;   // CLOCK_MONOTONIC, which tells what may be merged by now
    Nanoseconds epoch;  // since 1970, as source times
    std::int64_t step;
  };
  struct Topic {
    bus::TopicOnBus name;
    std::unique_ptr<bus::CdrReader> reader;
    std::map<bus::WriterHandle, bool> ours{};                // by writer
    std::array<std::optional<std::uint16_t>, 2> channels{};  // clients', ours
  };
  struct Waiting {
    Nanoseconds when;   // since 1970
    Nanoseconds taken;  // CLOCK_MONOTONIC
    std::size_t topic;
    bool ours;
    bus::CdrSample sample;
  };

  void Begin(const RecordingHead& head);
  void Run(const std::stop_token& stop);
  void Poll();
  void Subscribe();
  void Take();
  void Merge(Nanoseconds now, bool all);
  void WriteMoments(std::int64_t up_to_step, Nanoseconds up_to);
  void WriteTruth(const Truth& truth);
  void WriteEvents(std::int64_t up_to_step);
  void WriteHeldBack(const std::vector<emulator::ToldEvent>& held, std::int64_t step);
  void WriteEvent(const emulator::ToldEvent& told);
  void WriteSample(const Waiting& waiting, std::int64_t step);
  std::uint16_t ChannelOf(Topic* topic, bool ours);
  double TimeOf(std::int64_t step) const;  // simulated s
  std::uint64_t LogTime(std::int64_t step) const;

  const bus::Participant& participant_;
  bus::ParticipantKey ours_;
  bus::EndpointWatch watch_;
  std::set<bus::TopicOnBus> seen_;
  std::vector<Topic> topics_;
  Nanoseconds timestep_;
  std::uint64_t start_;  // ns since 1970
  Say say_;
  McapWriter writer_;
  std::uint16_t truth_channel_ = 0, event_channel_ = 0;
  std::map<std::string, std::uint16_t> schemas_;
  emulator::EventRing::Reader events_;
  emulator::EventDigest digest_{kEventEvery - 1e-6};  // 0.3 - 0.2 is less than 0.1
  emulator::Event event_;                             // the next, where there is one
  bool has_event_ = false;
  SpscRing<Moment> moments_;
  SpscRing<StepMark> marks_;
  std::vector<Waiting> waiting_;
  BytesOut message_;
  Nanoseconds last_take_ = 0;   // since 1970
  Nanoseconds last_flush_ = 0;  // CLOCK_MONOTONIC
  std::int64_t marked_ = -1;    // the last step known to be done
  std::uint64_t told_dropped_ = 0;

  std::atomic<bool> failed_{false};
  std::atomic<std::uint64_t> messages_{0}, bytes_{0};
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace understudy::record
