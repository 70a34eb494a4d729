// Joints that nothing drives come to rest for good, as dry friction has it.
#pragma once

#include <cstddef>
#include <vector>

namespace understudy::drive {

// MuJoCo's dry friction gives way slowly under any load, so that a robot which lies on its legs
// slides off them within half a minute. A real joint that has stopped sticks until more than its
// friction turns it. Allocates only in the constructor.
class Stiction {
 public:
  static constexpr double kStill = 0.01;  // rad/s below which a joint is at rest, *assumed*
  static constexpr double kMoves = 0.05;  // rad/s above which it has broken loose, *assumed*
  static constexpr double kAfter = 1;     // s at rest until it sticks, *assumed*

  explicit Stiction(std::size_t motors) : joints_(motors) {}

  // Lets go of all joints.
  void Restart();

  // Returns whether the joint of a motor, at `rate` [rad/s], sticks after a step of dt [s]. One
  // that is driven does not; a motor that only brakes drives nothing.
  bool Step(std::size_t motor, bool driven, double rate, double dt);

 private:
  struct Joint {
    double rest = 0;  // s
    bool sticks = false;
  };

  std::vector<Joint> joints_;
};

}  // namespace understudy::drive
