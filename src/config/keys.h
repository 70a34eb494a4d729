// Lists the keys of the configuration, one row each.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "config/config.h"
#include "schema/archive.h"

namespace understudy::config {

using schema::About;
using schema::Archive;
using schema::kNotNegative;
using schema::Named;
using schema::Range;

inline constexpr double kMaxInt = std::numeric_limits<int>::max();

// Returns the poses that a run can start in.
const std::vector<std::string>& StartPoses();

// The keys of a robot alone in its world stand beside those of the world; those of several, each
// by its name, in `robots`.
void Describe(Archive& archive, Config& config);
// Returns the keys that a robot in `robots` may have, without those by which it names its file.
const std::vector<std::string>& RobotConfigKeys();
void Describe(Archive& archive, robot::RobotSpec& robot);
void DescribeMotorType(Archive& archive, robot::MotorTypeSpec& type);
void DescribeMotor(Archive& archive, robot::MotorSpec& motor);
void DescribeParallel(Archive& archive, robot::ParallelSpec& parallel);
void DescribeDynamics(Archive& archive, robot::DynamicsSpec& dynamics);
void DescribeBus(Archive& archive, robot::BusSpec& bus);
void DescribeHand(Archive& archive, robot::HandSpec& hand);
void DescribeThermal(Archive& archive, robot::ThermalSpec& thermal);
void DescribeMotionService(Archive& archive, robot::MotionSpec& motion);
void DescribeSensors(Archive& archive, sensors::SensorConfig& sensors);
// Only `scene` and `terrain`, which are the keys that a scene's YAML file may have.
void DescribeScene(Archive& archive, Config& config);

}  // namespace understudy::config
