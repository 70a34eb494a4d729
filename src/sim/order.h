// What the outside asks of a running robot: people through `ctl`, scripts, and later others.
#ifndef UNDERSTUDY_SIM_ORDER_H_
#define UNDERSTUDY_SIM_ORDER_H_

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include <Eigen/Core>

namespace understudy {

struct LowerCrane {
  double by = 0;  // m; negative raises
};
struct AttachCrane {};  // from straight above, where the robot is
struct ReleaseCrane {};
struct ClampBase {
  bool on = true;
};
struct ResetRobot {};  // back to the start pose, command gate included; services stay on or off

// A force [N], world axes, on a body's centre of mass for a time.
struct PushBody {
  std::string body{};  // of the model; "" = the base
  Eigen::Vector3d force{0, 0, 0};
  double seconds = 0;  // simulated
};

// Keys are bits, see robot/remote_keys.h. Each of these makes the remote controller be there.
struct PressRemote {
  std::uint16_t keys = 0;
  double seconds = 0.1;  // simulated, that they stay down (the default is *assumed*)
};
struct HoldRemote {  // until they are released
  std::uint16_t keys = 0;
};
struct ReleaseRemote {
  std::uint16_t keys = 0xFFFF;
};
// Sticks, -1..1; one that is not named stays.
struct MoveSticks {
  std::optional<double> lx{}, ly{}, rx{}, ry{};
  double seconds = 0;  // simulated, after which those named come back to the middle; 0 = never
};
struct SwitchRemote {  // off: keys and sticks are let go and nothing is received
  bool on = true;
};

using Order = std::variant<LowerCrane, AttachCrane, ReleaseCrane, ClampBase, ResetRobot, PushBody,
                           PressRemote, HoldRemote, ReleaseRemote, MoveSticks, SwitchRemote>;

// An order that a script gives.
struct ScriptEvent {
  double at = 0;  // simulated s
  Order order{};
  std::string where{};  // "stand.yaml:3"
};

}  // namespace understudy

#endif  // UNDERSTUDY_SIM_ORDER_H_
