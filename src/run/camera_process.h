// The process that draws what the cameras of a robot see.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

#include "base/unique_fd.h"
#include "emulator/snapshot.h"
#include "robot/robot_spec.h"

namespace understudy::run {

// `understudy-view camera`: with OpenGL, which the daemon does not link. It gets its model from the
// robot's control socket.
class CameraProcess {
 public:
  // The parts of a snapshot of which a picture is made.
  static constexpr emulator::SnapshotParts kParts = emulator::kPartPositions | emulator::kPartCrane;

  // What is to be made of a picture.
  struct Wanted {
    bool jpeg = true;
    bool frame = false;  // of the camera's video
    bool depth = false;
    bool again = false;  // of its last picture, if there is one, instead of the state's
    double light = 1;    // share of it
    double noise = 0;    // levels, as robot::CameraEffects
  };
  // What is not wanted is empty.
  struct Drawn {
    std::vector<std::uint8_t> jpeg;
    std::vector<std::uint8_t> depth;  // PNG of 16 bits, mm
    std::vector<std::uint8_t> frame;  // H.264, Annex B
  };

  // Starts `program`. Throws SetupError if it cannot be run.
  CameraProcess(const std::filesystem::path& program, const std::filesystem::path& control_socket);
  // Ends it.
  ~CameraProcess();
  CameraProcess(const CameraProcess&) = delete;
  CameraProcess& operator=(const CameraProcess&) = delete;

  // Draws the picture of a state. Throws SetupError with the reason if there is none; the process
  // is then of no more use.
  Drawn Draw(const robot::CameraSpec& camera, const Wanted& wanted,
             const emulator::Snapshot& state);

  // Has a Draw in another thread throw at once.
  void Interrupt() const;

 private:
  UniqueFd socket_;
  pid_t pid_ = -1;
};

}  // namespace understudy::run
