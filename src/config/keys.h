// Lists the keys of the configuration, one row each.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "config/archive.h"
#include "config/config.h"

namespace understudy::config {

inline constexpr double kMaxInt = std::numeric_limits<int>::max();

// Returns the poses that a run can start in.
const std::vector<std::string>& StartPoses();

void Describe(Archive& archive, Config& config);
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
