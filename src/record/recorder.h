// Records a run: all topics of the bus, the simulation's truth, the events and the damage sheet.
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
#include "emulator/status.h"
#include "emulator/told_event.h"
#include "record/audience.h"
#include "record/mcap_writer.h"
#include "record/ros_topics.h"
#include "record/truth.h"

namespace understudy::record {

// The description of the run at the beginning of the file.
struct RecordingHead {
  StringMap about;                // metadata "understudy"
  std::string config;             // attachment config.yaml
  std::string model;              // attachment model.mjb
  Damage damage{};                // joints and limits of the damage sheet, and as many motors
  std::optional<RosRobot> ros{};  // the topics of ros_topics.h; none: they are left out
  std::size_t events_of = 0;  // the number of the robot whose events and the world's are written
  BaseAddress base{};         // of the truth
  ObjectAddresses objects{};  // of the truth
  std::optional<std::uint64_t> start{};  // when the run began, ns since 1970; none: by the clock
};

// The truth between two steps, offered by the loop.
struct Moment {
  std::int64_t wall = 0;  // ns, CLOCK_MONOTONIC, of the offer
  Truth truth;
};

// The damage sheet at an instant.
struct DamageMoment {
  std::int64_t wall = 0;  // ns, CLOCK_MONOTONIC
  Damage damage;
};

// In a burst of events each cause is recorded once in this simulated time [s]; *assumed*.
inline constexpr double kEventEvery = 0.1;

// Its thread takes the serialized messages of all topics (those of our participant, and others as
// they are discovered) and merges them with the moments of the loop into one file, in order of
// time.
//
// The log_time of a message is the start of the run, by the clock unless the head says otherwise,
// or what it was had the run kept to real time so far, plus the simulated time of the tick in which
// it was sent or could first be taken.
class Recorder {
 public:
  // Receives lines for the log; `error` tells warnings from errors.
  using Say = std::function<void(const std::string& line, bool error)>;

  // Writes the beginning of the file and starts the thread. Topics that `participant` already has
  // are recorded from their first message on. Step `first_step` is the first to come: the events
  // before it are left out. `events` must outlive the recorder. The vectors of
  // `moment` have the sizes of those to be offered. `audience` may be null; it must outlive the
  // recorder. Throws RecordError and BusError.
  Recorder(const bus::Participant& participant, OutputFile file, const RecordingHead& head,
           const emulator::EventRing* events, const Moment& moment,
           std::chrono::nanoseconds timestep, std::int64_t first_step, Say say,
           Audience* audience = nullptr);
  // Takes the remaining messages and finishes the file.
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  // For the loop's thread. None of these functions but CatchUp waits or allocates.
  //
  // Call it after every tick: step `step` is done and its messages are sent.
  void Mark(std::int64_t step);
  // Returns a moment to fill in and commit; nullptr if the recording has failed or, counted as
  // dropped, if its thread is far behind.
  Moment* Claim();
  void Commit();
  // The same for the damage sheet, of which joints and limits stand in it. Now and then: a sheet
  // for which there is no room yet is left out, since the next has all that stands in it.
  DamageMoment* ClaimDamage();
  void CommitDamage();
  // Returns whether the thread is so far behind that a loop without deadlines should wait for it.
  bool behind() const;
  // Waits until all that was marked and committed is written, or the recording has failed.
  void CatchUp();

  // Any thread.
  emulator::RecordingStatus status() const;

 private:
  using Nanoseconds = std::int64_t;
  struct StepMark {
    Nanoseconds wall;   // CLOCK_MONOTONIC, decides what may be merged
    Nanoseconds epoch;  // since 1970, for comparison with source times
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
  void BeginRos();
  void WriteSheets(std::int64_t up_to_step, Nanoseconds up_to);
  void WriteEvents(std::int64_t up_to_step);
  void WriteHeldBack(const std::vector<emulator::ToldEvent>& held, std::int64_t step);
  void WriteEvent(const emulator::ToldEvent& told);
  void WriteSample(const Waiting& waiting, std::int64_t step);
  std::uint16_t AddChannel(const std::string& topic, const std::string& type, std::uint16_t schema,
                           const StringMap& metadata);
  void Write(std::uint16_t channel, std::uint64_t log_time, std::uint64_t publish_time,
             ByteSpan data);
  std::uint16_t ChannelOf(Topic* topic, bool ours);
  double TimeOf(std::int64_t step) const;  // simulated s
  std::uint64_t LogTime(std::int64_t step) const;

  const bus::Participant& participant_;
  bus::ParticipantKey ours_;
  bus::EndpointWatch watch_;
  std::set<bus::TopicOnBus> seen_;
  std::size_t unknown_ = 0;  // topics whose type is not known
  std::vector<Topic> topics_;
  Nanoseconds timestep_;
  std::uint64_t start_;  // ns since 1970
  Say say_;
  Audience* audience_;
  struct Told {  // to the audience
    McapChannel channel;
    std::string type;
  };
  std::map<std::uint16_t, Told> told_channels_;
  McapWriter writer_;
  std::uint16_t truth_channel_ = 0, event_channel_ = 0, damage_channel_ = 0;
  std::optional<RosRobot> ros_;
  std::uint16_t tf_channel_ = 0, joint_states_channel_ = 0, clock_channel_ = 0;
  std::map<std::string, std::uint16_t> schemas_;
  std::size_t events_of_;  // a robot's number
  emulator::EventRing::Reader events_;
  emulator::EventDigest digest_{kEventEvery - 1e-6};  // rounding: 0.3 - 0.2 < 0.1
  emulator::Event event_;                             // the next event, if has_event_
  bool has_event_ = false;
  SpscRing<Moment> moments_;
  SpscRing<DamageMoment> sheets_;
  SpscRing<StepMark> marks_;
  std::vector<Waiting> waiting_;
  BytesOut message_;
  Nanoseconds last_take_ = 0;   // since 1970
  Nanoseconds last_flush_ = 0;  // CLOCK_MONOTONIC
  std::int64_t marked_;         // the last step known to be done
  std::uint64_t told_dropped_ = 0;

  std::atomic<std::uint64_t> asked_{0}, answered_{0};  // calls of CatchUp
  std::atomic<bool> failed_{false};
  std::atomic<std::uint64_t> messages_{0}, bytes_{0};
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace understudy::record
