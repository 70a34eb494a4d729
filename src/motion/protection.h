// How a motion service protects the robot by itself: a table of dangers, and a service that watches
// for them.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "authority/motion.h"
#include "physics/robot_body.h"
#include "robot/protection.h"
#include "robot/robot_spec.h"

namespace understudy::motion {

// What a danger is measured by.
struct DangerSenses {
  const robot::RobotSpec& spec;
  const authority::MotionInput& sensed;
  std::span<const std::array<double, 2>> ranges;  // rad, of the joints, in motor order
  Eigen::Vector3d up_I;      // the base's up in the frame of LowState's inertial unit, joints at 0
  bool remote_gone = false;  // nothing is received of the remote since its sticks led the robot
};

// The measure of a danger, in the unit of its row.
struct DangerMeasure {
  double value = 0;
  std::int16_t motor = -1;  // in motor order, of which it is; -1: of none
};

// One danger. A new one is a row here, its rule in robot::ProtectionSpec and its name in
// robot::Danger.
struct DangerRow {
  std::string_view name;  // of its rule, and in events
  std::string_view unit;  // of its measure
  std::string_view is;    // for the documentation
  robot::ProtectionRule robot::ProtectionSpec::*rule;
  DangerMeasure (*measure)(const DangerSenses& senses);
  bool below = false;  // the danger is a measure below the limit, not above it
  // Whether a goal is still taken while the danger stands and the service does more than tell it;
  // null: all goals.
  bool (*allows)(const authority::MotionGoal& goal) = nullptr;
};

// Returns the rows in the order of robot::Danger.
std::span<const DangerRow> Dangers();

// Another motion service with its protection: before each of its steps the dangers are measured by
// what it senses. One beyond its limit for its time stands until it no longer is; then the service
// is given the goal that the rule names, at once, and takes only what the row allows. A fall is
// noticed only where the service takes it for one. Allocates only in the constructor.
class ProtectedMotion final : public authority::Motion {
 public:
  // `spec` must outlive it.
  ProtectedMotion(const robot::RobotSpec& spec, const physics::RobotBody& body,
                  std::unique_ptr<authority::Motion> motion);

  void Start(const authority::MotionInput& input) override;
  authority::MotionVerdict Ask(const authority::MotionGoal& goal) override;
  void Step(const authority::MotionInput& input, double dt, robot::RobotCommand* command) override;
  robot::MotionState state() const override;

 private:
  // Does what the rule says; returns whether the service has taken it.
  bool Act(robot::Danger danger, robot::Protection does);

  const robot::RobotSpec& spec_;
  std::vector<std::array<double, 2>> ranges_;
  Eigen::Vector3d up_I_;
  std::unique_ptr<authority::Motion> motion_;
  std::array<double, robot::kDangers> beyond_{}, fine_{};  // s that each has been, or not been
  std::array<robot::DangerReading, robot::kDangers> dangers_{};
  bool led_by_sticks_ = false;  // when the remote controller was last received
};

}  // namespace understudy::motion
