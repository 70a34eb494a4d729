// The remote controller in somebody's hands.
#ifndef UNDERSTUDY_EMULATOR_REMOTE_H_
#define UNDERSTUDY_EMULATOR_REMOTE_H_

#include <array>

#include "emulator/order.h"
#include "robot/robot_values.h"

namespace understudy::emulator {

// Not there until the first order. Times are simulated and never go back. Allocates nothing.
class Remote {
 public:
  void Press(const PressRemote& order, double t);
  void Hold(const HoldRemote& order);
  void Release(const ReleaseRemote& order);
  void Move(const MoveSticks& order, double t);
  void Set(const SetRemote& order, double t);
  void Switch(const SwitchRemote& order);

  // What it sends at time t [s].
  const robot::RemoteReading& Read(double t);

 private:
  struct Stick {
    double value = 0;
    double until = 0;  // s
  };

  std::array<double, 16> down_until_{};  // s, by key
  std::array<Stick, 4> sticks_{};        // lx, ly, rx, ry
  robot::RemoteReading reading_;
};

}  // namespace understudy::emulator

#endif  // UNDERSTUDY_EMULATOR_REMOTE_H_
