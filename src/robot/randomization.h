// What a run leaves to chance: ranges, dice that throw the same for the same seed, and motors.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "robot/robot_spec.h"

namespace understudy::robot {

// Each quantity is a range, least and most, or empty: then it is as the robot's description and
// model say. Meaning, unit and bounds stand in config/randomization_keys.cc.
struct RandomizationSpec {
  using Limits = std::vector<double>;

  int seed = -1;  // -1: one is drawn
  Limits friction{}, mass{}, base_com{}, inertia{}, motor_strength{}, damping{}, armature{},
      frictionloss{}, timestep{}, kp{}, kd{}, delay{}, imu_mounting{}, gravity_tilt{},
      floor_softness{};
};

// One value that was drawn.
struct Drawn {
  std::string quantity;  // the key of its range
  std::string element;   // body, joint or axis; "" where the quantity is one number
  double value = 0;

  friend bool operator==(const Drawn&, const Drawn&) = default;
};

// All that a run has drawn. A seed below 0: nothing.
struct Draws {
  int seed = -1;
  std::vector<Drawn> values;
};

// Draws evenly from ranges. A value depends on the seed, the quantity, the element and the range
// alone: another quantity more, or another order, changes none. The same on every machine.
class Dice {
 public:
  // `seed` is not negative.
  explicit Dice(int seed) : draws_{.seed = seed, .values = {}} {}

  // From low to high, which must be finite and in order; low where they are equal.
  double Draw(std::string_view quantity, std::string_view element, double low, double high);
  // The same from limits, or nothing and `otherwise` where those are empty.
  double DrawOr(std::string_view quantity, std::string_view element,
                const RandomizationSpec::Limits& limits, double otherwise);
  // One of some values, of which there is at least one, each as likely.
  double DrawOneOf(std::string_view quantity, const std::vector<double>& values);

  const Draws& draws() const { return draws_; }

 private:
  double Throw(std::string_view quantity, std::string_view element) const;  // from 0, below 1
  double Note(std::string_view quantity, std::string_view element, double value);

  Draws draws_;
};

// The physics steps [s] within the limits that go a whole number of times, and in whole
// nanoseconds, into the periods of LowState and of the motion service; the longest first.
std::vector<double> PossibleTimesteps(const RandomizationSpec::Limits& limits,
                                      const RateSpec& rates);

// Strength, gains and delay of the robot's motors.
void RandomizeMotors(const RandomizationSpec& ranges, Dice* dice, RobotSpec* robot);

}  // namespace understudy::robot
