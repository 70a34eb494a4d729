// The state of a robot at one instant, for drawing.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace understudy::viewer {

using Point = std::array<double, 3>;  // m, or N; world frame unless said otherwise

struct SceneState {
  struct Force {
    Point at{};
    Point force{};  // N
  };
  struct Crane {
    Point hook{};
    Point top{};
    double tension = 0;  // N
  };

  std::int64_t step = 0;
  double time = 0;   // s, simulated
  double speed = 1;  // as requested; 0 is as fast as possible
  bool paused = false;
  std::vector<double> qpos;  // mjData::qpos
  std::vector<Force> contacts;
  std::vector<Force> pushes;
  std::optional<Crane> crane;
  std::string keys;  // pressed on the remote controller, as in "L2+B"
};

// Reads a Snapshot of the control plane (docs/reference/control.md), of which at least "step",
// "time" and `nq` numbers of "qpos" have to be there. Throws ControlError that says what is wrong.
SceneState ReadSnapshot(const std::string& text, std::size_t nq);

}  // namespace understudy::viewer
