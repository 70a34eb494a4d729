// Randomizes quantities: ranges, random draws that repeat for equal seeds, and the motors' values.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "robot/robot_spec.h"

namespace understudy::robot {

// Each quantity is a range [least, most], or empty for the value of the robot's description and
// model. config/randomization_keys.cc has meaning, unit and bounds.
struct RandomizationSpec {
  using Limits = std::vector<double>;

  int seed = -1;  // -1: draws a seed
  Limits friction{}, mass{}, base_com{}, inertia{}, motor_strength{}, damping{}, armature{},
      frictionloss{}, timestep{}, kp{}, kd{}, delay{}, imu_mounting{}, gravity_tilt{},
      floor_softness{};
};

// One drawn value.
struct Drawn {
  std::string quantity;  // the key of its range
  std::string element;   // body, joint or axis; "" if the quantity is one number
  double value = 0;

  friend bool operator==(const Drawn&, const Drawn&) = default;
};

// All drawn values of a run. A seed below 0 means none.
struct Draws {
  int seed = -1;
  std::vector<Drawn> values;
};

// Draws uniformly from ranges. A value depends only on seed, quantity, element and range, not on
// other draws or their order, and is the same on every machine.
class Randomizer {
 public:
  // `seed` must not be negative.
  explicit Randomizer(int seed) : draws_{.seed = seed, .values = {}} {}

  // Draws from [low, high], which must be finite and in order.
  double Draw(std::string_view quantity, std::string_view element, double low, double high);
  // Draws from `limits`; if they are empty, draws nothing and returns `otherwise`.
  double DrawOr(std::string_view quantity, std::string_view element,
                const RandomizationSpec::Limits& limits, double otherwise);
  // Draws one of `values`, which must not be empty, with equal probability.
  double DrawOneOf(std::string_view quantity, const std::vector<double>& values);

  const Draws& draws() const { return draws_; }

 private:
  double Throw(std::string_view quantity, std::string_view element) const;  // in [0, 1)
  double Note(std::string_view quantity, std::string_view element, double value);

  Draws draws_;
};

// Returns the physics steps [s] within the limits that are whole nanoseconds and divide the periods
// of LowState and of the motion service, longest first.
std::vector<double> PossibleTimesteps(const RandomizationSpec::Limits& limits,
                                      const RateSpec& rates);

// Draws strength, gains and delay of the robot's motors. `prefix` stands before the names of one of
// several robots: "left/".
void RandomizeMotors(const RandomizationSpec& ranges, const std::string& prefix,
                     Randomizer* randomizer, RobotSpec* robot);

}  // namespace understudy::robot
