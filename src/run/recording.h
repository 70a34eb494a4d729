// Connects the loop to the recorder.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <semaphore>
#include <string>
#include <thread>

#include "bus/participant.h"
#include "config/config.h"
#include "emulator/world.h"
#include "record/recorder.h"
#include "robot/randomization.h"
#include "time/pacer.h"

namespace understudy::run {

inline constexpr std::int64_t kHeardEvery = 100;

struct RecordingOptions {
  std::filesystem::path file;  // empty: no recording
  bool overwrite = false;
  // Hears what is written; may be null. A run as fast as possible waits for it every kHeardEvery
  // steps, so that what it knows then depends on nothing but the run.
  record::Audience* audience = nullptr;
};

// The recording of a run: of all of it if it is given a file, and, but for one with an audience, of
// any part of it that requests ask for. Files are opened and finished in a thread of its own.
class Recording {
 public:
  // Call it after ports and services have opened their topics. `config` is that of the run; `world`
  // has made no step yet. All must outlive the recording. Throws RecordError and BusError.
  Recording(const RecordingOptions& options, const bus::Participant& participant,
            const config::Config& config, const robot::Draws& draws, emulator::World* world);
  // Offers the damage sheet once more, and takes what is left. The loop has ended.
  ~Recording();
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  // Offers the state after a tick. Never waits or allocates, except that a run as fast as possible
  // waits for the recorder.
  void Offer(const time::Pacer& pacer);

  // Carries out what requests have asked for. Call it between ticks. Never waits. Returns whether
  // one is done: its answer goes out with the next tick, so show the status before.
  bool Follow();

  emulator::RecordingStatus status() const;

 private:
  // What the thread does next: it starts a recording, or finishes one.
  struct Job {
    std::filesystem::path file{};
    bool overwrite = false;
    std::int64_t first_step = 0;
    std::unique_ptr<record::Recorder> recorder{};  // that is to be finished, or was started
    std::string why{};                             // it could not be started, if not ""
  };
  enum class Turn : std::uint8_t { kNobodys, kThreads, kTicks };

  std::unique_ptr<record::Recorder> Start(std::filesystem::path file, bool overwrite,
                                          std::int64_t first_step) const;
  void Begin(const emulator::RecordingOrder& order);
  void End();
  void Work(const std::stop_token& stop);
  void OfferDamage();

  const bus::Participant& participant_;
  const config::Config& config_;
  emulator::World& world_;
  record::Audience* audience_;
  record::RecordingHead head_;  // but for configuration and model
  record::Moment moment_;
  std::int64_t every_;           // steps from one LowState to the next
  std::int64_t sheet_every_;     // steps from one damage sheet to the next
  std::int64_t sheet_step_ = 0;  // of the last one
  std::unique_ptr<record::Recorder> recorder_;
  std::filesystem::path file_;  // that is being written
  Job job_;                     // of whoever's turn it is
  std::atomic<Turn> turn_{Turn::kNobodys};
  std::counting_semaphore<> wake_{0};
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace understudy::run
