#include "motion/humanoid/senses.h"

#include <algorithm>
#include <numeric>

#include "base/errors.h"

namespace understudy::motion {
namespace {

constexpr double kPeriod = 0.004;  // s: the body needs 1/20 of that per step of feedback

// Assumed, tried on every robot here.
constexpr double kLoadTime = 0.03;  // s, over which foot loads are smoothed
constexpr double kFullLoad = 0.9;   // share of the weight from which a robot stands by itself
constexpr double kContact = 0.05;   // share of the weight from which a foot bears load

}  // namespace

HumanoidSenses::HumanoidSenses(const mjModel& model, const robot::RobotSpec& spec)
    : body_(model, spec),
      q_(spec.motors.size()),
      dq_(spec.motors.size()),
      reading_{.q = q_, .dq = dq_, .body = body_} {
  if (body_.soles().size() != 2) throw ModelError(spec.name + ": expected two feet (feet)");
}

void HumanoidSenses::Begin(const authority::MotionInput& input) {
  Take(input);
  reading_.load = Load(input);
  body_.Update(q_, dq_, input.imu);
  fresh_ = true;
}

void HumanoidSenses::Step(const authority::MotionInput& input, double dt) {
  Take(input);
  reading_.load += (Load(input) - reading_.load) * dt / (dt + kLoadTime);
  reading_.since_worked_out = 0;
  waited_ += dt;
  if (!fresh_ && waited_ <= kPeriod - dt / 2) return;
  body_.Update(q_, dq_, input.imu);
  reading_.since_worked_out = fresh_ ? kPeriod : waited_;
  waited_ = 0;
  fresh_ = false;
}

void HumanoidSenses::Take(const authority::MotionInput& input) {
  for (std::size_t i = 0; i < q_.size(); ++i) {
    q_[i] = input.motors[i].q;
    dq_[i] = input.motors[i].dq;
  }
  reading_.imu = input.imu;
  for (std::size_t foot = 0; foot < reading_.contacts.size(); ++foot) {
    reading_.contacts[foot] = input.foot_force[foot] > kContact * body_.mass() * body_.gravity();
  }
}

double HumanoidSenses::Load(const authority::MotionInput& input) const {
  const double force = std::accumulate(input.foot_force.begin(), input.foot_force.end(), 0.0);
  return std::clamp(force / (kFullLoad * body_.mass() * body_.gravity()), 0.0, 1.0);
}

}  // namespace understudy::motion
