// The description of the smallest robot.
#pragma once

namespace understudy::test {

// Two motors, a foot, everything a robot needs.
inline constexpr char kTinyRobot[] = R"(robot:
  name: tiny
  model: tiny.xml
  base_body: base
  motors:
    - {joint: a, slot: 0, torque_limit: 10, knee_speed: 5, no_load_speed: 8}
    - {joint: b, slot: 1, torque_limit: 20}
  imu: {site: imu}
  feet: [{name: left, geoms: [left_1]}]
  battery: {cells: 8, capacity_ah: 8}
  lying: {q: [0, 0.5], height: 0.1}
  standing: {q: [0, 0.1], height: 0.5}
  hanging: {q: [0, 0], height: 1}
  crane_body: base
  default_start: hanging
)";

}  // namespace understudy::test
