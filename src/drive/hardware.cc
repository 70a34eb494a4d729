#include "drive/hardware.h"

#include <algorithm>
#include <cstddef>

namespace understudy::drive {

Hardware::Hardware(const robot::RobotSpec& spec, const sensors::SensorConfig& sensors,
                   const robot::FaultBank& faults, const robot::RobotCommand& start,
                   physics::RobotBody* body, double dt)
    : faults_(faults),
      body_(body),
      dt_(dt),
      rig_(spec),
      transport_(spec, dt, sensors.seed, start),
      encoders_(sensors::EncoderZeros(sensors, spec), sensors.seed),
      motors_(spec, dt),
      gears_(spec, body->Armatures(), dt),
      battery_(spec.battery, spec.thermal.ambient_c, sensors.seed),
      board_(spec),
      sensors_(sensors, spec, dt),
      damage_(spec, body->ranges()),
      stiction_(faults.effects().motors.size()),
      braked_(faults.effects().motors.size()),
      friction_w_(braked_.size()) {}

void Hardware::Forget() {
  rig_.Release();
  transport_.Clear();
  ReadEncoders();
  sensors_.Restart(instant());
}

void Hardware::Restart(const robot::RobotCommand& start, const robot::PoseSpec& pose) {
  stiction_.Restart();
  for (std::size_t i = 0; i < braked_.size(); ++i) BrakeJoint(i, false);
  body_->Reset(pose);
  gears_.Restart();
  damage_.Restart();
  Forget();
  transport_.Restart(start);
}

void Hardware::SwitchOff() {
  on_ = false;
  battery_.SwitchOff();
  Forget();
}

bool Hardware::SwitchOn() {
  battery_.Restart();
  if (battery_.cut_off() != robot::CutOff::kNone) return false;
  on_ = true;
  Forget();
  return true;
}

void Hardware::Send(const robot::RobotCommand& command, double t) {
  if (!on_) return;
  const std::span<const robot::BusEffects> buses = faults_.effects().buses;
  transport_.Pass(rig_.Over(command, t, dt_), t, buses.first(faults_.any() ? buses.size() : 0));
}

void Hardware::Act() {
  const robot::Effects& faults = faults_.effects();
  BrakeJoints();
  ReadEncoders();
  body_->FrictionPower(friction_w_);
  motors_.Step({.command = transport_.followed(),
                .q = encoders_.q(),
                .dq = encoders_.dq(),
                .rate = body_->dq(),
                .friction_w = friction_w_,
                .supply = on_ ? battery_.supply()
                              : robot::MotorSupply{.voltage = 0, .most_power = 0, .on = false},
                .faults = faults.motors});
  body_->Drive(gears_.ideal() ? motors_.torque() : gears_.Step(motors_.torque(), body_->q()));
  if (on_) battery_.Step(motors_.power(), dt_, faults.battery);
  if (!board_.settled() || faults_.any()) board_.Step(dt_, faults.fans, faults.board);
}

void Hardware::Sense() {
  damage_.Step({.command = transport_.followed(),
                .q = body_->q(),
                .dq = body_->dq(),
                .torque = motors_.torque(),
                .winding_c = motors_.winding_c(),
                .battery = battery_.reading(),
                .f_WI_I = body_->Imu().f_WI_I,
                .tilt = body_->tilt()},
               dt_);
  if (on_) sensors_.Step(instant());
}

void Hardware::ReadEncoders() {
  if (!gears_.ideal()) gears_.AddPlay(body_->q(), body_->dq());
  encoders_.Step(gears_.ideal() ? body_->q() : gears_.q(),
                 gears_.ideal() ? body_->dq() : gears_.dq(), faults_.effects().encoders);
}

void Hardware::BrakeJoints() {
  for (std::size_t i = 0; i < braked_.size(); ++i) {
    // A motor that is limp, too hot or without power drives nothing, though it is asked to.
    const bool driven =
        robot::AsksForTorque(transport_.followed().motors[i]) && motors_.torque()[i] != 0;
    BrakeJoint(i, stiction_.Step(i, driven, body_->dq()[i], dt_));
  }
}

void Hardware::BrakeJoint(std::size_t motor, bool sticks) {
  using Grip = physics::RobotBody::Grip;
  const robot::MotorEffects& fault = faults_.effects().motors[motor];
  const JointBrake now{fault.drag, fault.jammed ? Grip::kJammed
                                   : sticks     ? Grip::kSticks
                                                : Grip::kYields};
  if (now == braked_[motor]) return;
  braked_[motor] = now;
  body_->Brake(motor, now.drag, now.grip);
}

}  // namespace understudy::drive
