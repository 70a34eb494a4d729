// The recording of a run, as the loop sees it.
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

struct RecordingOptions {
  std::filesystem::path file;  // empty: nothing is recorded
  bool overwrite = false;
};

// Does nothing at all where there is no file to record to.
class Recording {
 public:
  // After ports and services have opened their topics. `config` is that of the run, `world` has
  // made no step yet and outlives the recording. Throws RecordError and BusError.
  Recording(const RecordingOptions& options, const bus::Participant& participant,
            const config::Config& config, const robot::Draws& draws, const emulator::World& world);

  // After every tick and what belongs to it. Waits for nothing and allocates nothing, but for a run
  // that goes as fast as possible: that goes no faster than it can be recorded.
  void Offer(const emulator::World& world, const time::Pacer& pacer);

  emulator::RecordingStatus status() const;

 private:
  std::int64_t every_;  // steps from one LowState to the next
  std::unique_ptr<record::Recorder> recorder_;
};

}  // namespace understudy::run
