// Processes the sensor readings of a humanoid's motion service.
#pragma once

#include <vector>

#include "authority/motion.h"
#include "motion/humanoid/behaviour.h"

namespace understudy::motion {

// Passes angles on, smooths the load on the feet, and updates the body model every few
// milliseconds.
class HumanoidSenses {
 public:
  // `model` and `spec` are as for BodyModel; `spec` must have two feet.
  HumanoidSenses(const mjModel& model, const robot::RobotSpec& spec);
  HumanoidSenses(const HumanoidSenses&) = delete;
  HumanoidSenses& operator=(const HumanoidSenses&) = delete;

  // Starts without history.
  void Begin(const authority::MotionInput& input);
  // Makes one step of dt [s], at the end of which `input` was sampled.
  void Step(const authority::MotionInput& input, double dt);

  const HumanoidReading& reading() const { return reading_; }  // of the last Begin or Step
  BodyModel* body() { return &body_; }

 private:
  double Load(const authority::MotionInput& input) const;
  void Take(const authority::MotionInput& input);

  BodyModel body_;
  std::vector<double> q_, dq_;  // rad, rad/s
  double waited_ = 0;           // s since the update of the body model
  bool fresh_ = true;           // no step since Begin
  HumanoidReading reading_;
};

}  // namespace understudy::motion
