// What the outside asks of a running robot: people through `ctl`, scripts, and later others.
#ifndef UNDERSTUDY_EMULATOR_ORDER_H_
#define UNDERSTUDY_EMULATOR_ORDER_H_

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include <Eigen/Core>

#include "robot/robot_values.h"
#include "robot/start_pose.h"

namespace understudy::emulator {

struct LowerCrane {
  double by = 0;  // m; negative raises
};
struct AttachCrane {};  // from straight above, where the robot is
struct ReleaseCrane {};
struct ClampBase {
  bool on = true;
};
// Back to a pose, the start pose unless one is named, command gate included; services stay on or
// off.
struct ResetRobot {
  std::optional<robot::StartPose> pose{};
};

// A force [N], world axes, on a body's centre of mass for a time.
struct PushBody {
  std::string body{};  // of the model; "" = the base
  Eigen::Vector3d force{0, 0, 0};
  double seconds = 0;  // simulated
};

// Drags a point of a body to a point in the world, see Drags, until it is told anew, released or
// its time is over. Who drags renews it more often than that; who is gone does not drag on.
struct DragBody {
  std::string body{};             // of the model
  Eigen::Vector3d p_BP{0, 0, 0};  // m, in the body's frame
  Eigen::Vector3d p_WT{0, 0, 0};  // m, in the world
  double seconds = 0.5;           // simulated; *assumed*
};
struct ReleaseDrag {
  std::string body{};  // "" = all
};

// Simulated time stands still: nothing is sent, orders and services go on being answered.
struct PauseRun {
  bool on = true;
};
struct StepRun {  // while paused: this many steps, at the speed that is set, then paused again
  std::int64_t steps = 1;
};
struct SetSpeed {
  double speed = 1;  // simulated seconds per wall second; 0 = as fast as possible
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
// The whole remote at once, as it is in somebody's hands: keys that are not in it go up, sticks are
// where it says. Whoever holds it says so again and again: after `seconds` without another order
// all is let go, so that a program that died or hangs leaves nothing held.
struct SetRemote {
  robot::RemoteReading reading{};  // `there` is left aside: it is
  double seconds = 0;              // simulated
};
struct SwitchRemote {  // off: keys and sticks are let go and nothing is received
  bool on = true;
};

using Order = std::variant<LowerCrane, AttachCrane, ReleaseCrane, ClampBase, ResetRobot, PushBody,
                           DragBody, ReleaseDrag, PauseRun, StepRun, SetSpeed, PressRemote,
                           HoldRemote, ReleaseRemote, MoveSticks, SetRemote, SwitchRemote>;

// An order that a script gives.
struct ScriptEvent {
  double at = 0;  // simulated s
  Order order{};
  std::string where{};  // "stand.yaml:3"
};

}  // namespace understudy::emulator

#endif  // UNDERSTUDY_EMULATOR_ORDER_H_
