// Connects the loop to the recorder.
#pragma once

#include <filesystem>
#include <memory>

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

// The recording of a run; does nothing without a file.
class Recording {
 public:
  // Call it after ports and services have opened their topics. `config` is that of the run; `world`
  // has made no step yet and must outlive the recording. Throws RecordError and BusError.
  Recording(const RecordingOptions& options, const bus::Participant& participant,
            const config::Config& config, const robot::Draws& draws, const emulator::World& world);
  // Offers the damage sheet once more, and takes what is left. The loop has ended.
  ~Recording();
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  // Offers the state after a tick. Never waits or allocates, except that a run as fast as possible
  // waits for the recorder.
  void Offer(const time::Pacer& pacer);

  emulator::RecordingStatus status() const;

 private:
  void OfferDamage();

  const emulator::World& world_;
  std::int64_t every_;           // steps from one LowState to the next
  std::int64_t sheet_every_;     // steps from one damage sheet to the next
  std::int64_t sheet_step_ = 0;  // of the last one
  bool heard_;                   // by an audience
  std::unique_ptr<record::Recorder> recorder_;
};

}  // namespace understudy::run
