// What a humanoid's service makes of its sensors.
#pragma once

#include <vector>

#include "authority/motion.h"
#include "motion/humanoid/behaviour.h"

namespace understudy::motion {

// Takes angles as they come, smooths what the feet bear, and works the body out every few
// milliseconds.
class HumanoidSenses {
 public:
  // `model` and `spec` as for BodyModel, and `spec` has two feet.
  HumanoidSenses(const mjModel& model, const robot::RobotSpec& spec);
  HumanoidSenses(const HumanoidSenses&) = delete;
  HumanoidSenses& operator=(const HumanoidSenses&) = delete;

  // Nothing is known of before.
  void Begin(const authority::MotionInput& input);
  // One step of dt [s], at whose end `input` was taken.
  void Step(const authority::MotionInput& input, double dt);

  const HumanoidReading& reading() const { return reading_; }  // as of the last of these
  BodyModel* body() { return &body_; }

 private:
  double Load(const authority::MotionInput& input) const;
  void Take(const authority::MotionInput& input);

  BodyModel body_;
  std::vector<double> q_, dq_;  // rad, rad/s
  double waited_ = 0;           // s since the body was worked out
  bool fresh_ = true;           // no step since Begin
  HumanoidReading reading_;
};

}  // namespace understudy::motion
