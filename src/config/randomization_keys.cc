#include "config/randomization_keys.h"

#include <algorithm>
#include <array>

namespace understudy::config {
namespace {

constexpr Range kScale{0, 100};
constexpr Range kPositiveScale{0.01, 100};  // for quantities that must not be 0

using Spec = robot::RandomizationSpec;

// The name and the member of a range.
#define RANGE(name) #name, &Spec::name

const std::array<RandomRange, 15> kRanges{{
    {RANGE(friction),
     {"", kPositiveScale, "Sliding friction of every contact: factor on the model's"}},
    {RANGE(mass),
     {"", kPositiveScale,
      "Mass of each body of the robot: factor; its inertia is scaled by the same factor"}},
    {RANGE(base_com), {"m", {-1, 1}, "Centre of mass of the base: added, along each of its axes"}},
    {RANGE(inertia), {"", kPositiveScale, "Inertia of each body of the robot: factor"}},
    {RANGE(motor_strength), {"", kScale, "Torque of each motor, limit included: factor"}},
    {RANGE(damping), {"", kScale, "Damping of each motor's joint: factor"}},
    {RANGE(armature), {"", kScale, "Rotor inertia at each motor's joint: factor"}},
    {RANGE(frictionloss), {"", kScale, "Dry friction of each motor's joint: factor"}},
    {RANGE(timestep),
     {"s",
      {0.0001, 0.01},
      "Physics step in place of physics.timestep, drawn from those that divide the periods of "
      "LowState and "
      "of the motion service"}},
    {RANGE(kp), {"", kScale, "Effective kp of each motor: factor on the commanded one"}},
    {RANGE(kd), {"", kScale, "Effective kd of each motor: factor on the commanded one"}},
    {RANGE(delay), {"s", {0, 0.1}, "Time from command to torque: added to robot.dynamics.delay"}},
    {RANGE(imu_mounting),
     {"rad",
      {-3.2, 3.2},
      "Rotation of each inertial unit from its place: the components of a rotation vector"}},
    {RANGE(gravity_tilt),
     {"rad", {0, 1.5}, "Angle of gravity from the vertical, in a random direction"}},
    {RANGE(floor_softness), {"", kPositiveScale, "Compliance of contacts: factor on the model's"}},
}};

#undef RANGE

}  // namespace

std::span<const RandomRange> RandomRanges() { return kRanges; }

bool IsRandom(const robot::RandomizationSpec& spec) {
  return std::ranges::any_of(
      kRanges, [&spec](const RandomRange& range) { return !(spec.*range.limits).empty(); });
}

void DescribeRandomization(Archive& a, robot::RandomizationSpec& r) {
  a.Key(UNDERSTUDY_NVP(r.seed),
        {"",
         {-1, kMaxInt},
         "Seed of all draws; -1 draws a seed, which the log and `ctl status` show"});
  for (const RandomRange& range : kRanges) {
    a.Key(Named{range.name, &(r.*range.limits)}, range.about);
  }
}

}  // namespace understudy::config
