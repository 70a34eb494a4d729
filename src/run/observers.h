// What shows one robot of a run to its observers, and takes their requests to it.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "assembly/sight_model.h"
#include "config/config.h"
#include "emulator/inbox.h"
#include "emulator/status.h"
#include "emulator/world.h"
#include "physics/scene_reader.h"
#include "robot/randomization.h"
#include "run/attachments.h"
#include "run/cameras.h"
#include "run/guest.h"
#include "run/recording.h"
#include "run/run.h"
#include "server/server.h"

namespace understudy::run {

// Recording, snapshots, pictures, status, control socket and panel of a robot. Each robot of a
// world has its own, so that observers need not know that there are others.
class Observers {
 public:
  // The guest is open and `world` has made no step. All must outlive this, the inbox the world too.
  // Throws RecordError, BusError and SocketError.
  Observers(const RunOptions& options, const config::Config& config, const robot::Draws& draws,
            const std::shared_ptr<const assembly::SightModel>& sight, const Guest& guest,
            emulator::Inbox* inbox, emulator::World* world);
  Observers(const Observers&) = delete;
  Observers& operator=(const Observers&) = delete;

  // In the order of their turns.
  std::vector<Attachment*> attachments() { return {&snapshots_, &cameras_, &recording_, &poster_}; }
  Cameras& cameras() { return cameras_; }
  const emulator::StatusBoard& board() const { return board_; }
  const server::ControlServer& control() const { return control_; }
  bool recording_failed() const {
    return recording_.status().state == emulator::RecordingState::kFailed;
  }

 private:
  server::Plane MakePlane(const RunOptions& options, const config::Config& config,
                          const robot::Draws& draws, const Guest& guest, emulator::Inbox* inbox,
                          emulator::World* world);

  Snapshots snapshots_;
  emulator::StatusBoard board_;
  physics::SceneReader scene_;
  Cameras cameras_;
  server::ControlServer control_;
  Recording recording_;  // last: a start that is refused leaves an old file whole
  StatusPoster poster_;
};

}  // namespace understudy::run
