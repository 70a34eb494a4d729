#include "robot/motor.h"

#include <algorithm>
#include <cmath>

namespace understudy::robot {
namespace {

constexpr double kCooled = 10;         // °C below trip_c at which a motor works again; *assumed*
constexpr double kShareAtTrip = 0.5;   // of the torque limit; *assumed*
constexpr double kCopper = 0.00393;    // 1/°C, of copper's resistance about 20 °C
constexpr double kColdWinding_c = 25;  // for which watt_per_nm2 holds

MotorCommand Scaled(MotorCommand command, const MotorSpec& spec) {
  if (!command.enabled) return Locked(spec.lock_kd);
  command.kp *= spec.kp_scale;
  command.kd *= spec.kd_scale;
  return command;
}

std::size_t Index(int motor) { return static_cast<std::size_t>(motor); }

}  // namespace

std::vector<double> KdShares(const RobotSpec& spec) {
  std::vector<double> shares(AllMotors(spec).size(), 1.0);
  if (spec.dynamics.use != DynamicsSource::kFitted) return shares;
  for (std::size_t i = 0; i < spec.motors.size(); ++i) {
    for (const FittedDynamicsSpec& fit : spec.dynamics.fitted) {
      if (std::ranges::find(fit.slots, spec.motors[i].slot) != fit.slots.end()) {
        shares[i] = fit.kd_share;
      }
    }
  }
  return shares;
}

double FollowedAngle(double q, const std::array<double, 2>& clamp) {
  const bool any = clamp[0] == 0 && clamp[1] == 0;
  return any || q == kNoPosition ? q : std::clamp(q, clamp[0], clamp[1]);
}

double DesiredTorque(const MotorCommand& command, double q, double dq) {
  if (!command.enabled) return 0;
  double tau = command.tau;
  if (command.q != kNoPosition) tau += command.kp * (command.q - q);
  if (command.dq != kNoVelocity) tau += command.kd * (command.dq - dq);
  return std::clamp(tau, -command.most, command.most);
}

double AvailableTorque(const TorqueCurve& curve, double tau, double dq, double volts, double heat) {
  double limit = curve.limit;
  if (curve.knee > 0) {
    const double speed = tau < 0 ? -dq : dq;  // the way that it pushes
    const double room = volts * curve.no_load - speed;
    const double fall = curve.no_load - curve.knee;
    limit *= fall > 0 ? std::clamp(room / fall, 0.0, 1.0) : (room >= 0 ? 1.0 : 0.0);
  } else {
    limit *= volts;
  }
  limit = std::min(limit, heat * curve.limit);
  return std::clamp(tau, -limit, limit);
}

MotorBank::HeatPath MotorBank::HeatPathOf(const MotorTypeSpec& type, double period) {
  if (type.winding_c_per_w <= 0 || type.casing_c_per_w <= 0) return {};
  // d(winding)/dt and d(casing)/dt by the two temperatures over air: {{a, b}, {c, d}}.
  const double ratio = type.casing_c_per_w / type.winding_c_per_w;
  const double a = -1 / type.winding_time;
  const double b = 1 / type.winding_time;
  const double c = ratio / type.casing_time;
  const double d = -(1 + ratio) / type.casing_time;
  // Its exponential. b c > 0, so both eigenvalues are real and apart.
  const double mean = (a + d) / 2;
  const double apart = std::sqrt((a - d) * (a - d) / 4 + b * c);
  const double even = std::exp(mean * period) * std::cosh(apart * period);
  const double odd = std::exp(mean * period) * std::sinh(apart * period) / apart;
  return {.winding = type.winding_c_per_w,
          .casing = type.casing_c_per_w,
          .decay = {even + odd * (a - mean), odd * b, odd * c, even + odd * (d - mean)}};
}

MotorBank::MotorBank(const RobotSpec& spec, double dt)
    : thermal_(spec.thermal),
      motors_(AllMotors(spec)),
      heat_steps_(std::max(1, static_cast<int>(std::lround(kHeatPeriod / dt)))),
      kd_share_(KdShares(spec)),
      torque_(motors_.size()),
      current_(motors_.size()),
      rate_(motors_.size()),
      winding_w_(motors_.size()),
      casing_w_(motors_.size()),
      winding_rise_(motors_.size()),
      casing_rise_(motors_.size()),
      winding_c_(motors_.size(), spec.thermal.ambient_c + spec.thermal.rest_rise_c),
      casing_c_(winding_c_),
      heat_share_(motors_.size(), 1.0) {
  const MotorTypeSpec ideal;  // without losses, at any voltage
  for (const MotorSpec* motor : motors_) {
    const MotorTypeSpec* named = FindMotorType(spec, motor->type);
    const MotorTypeSpec& type = named == nullptr ? ideal : *named;
    curves_.push_back({motor->torque_limit, motor->knee_speed, motor->no_load_speed});
    least_v_.push_back(kLeastVoltage * type.rated_v);
    per_volt_.push_back(type.rated_v > 0 ? 1 / type.rated_v : 0);
    own_share_.push_back(1 / motor->gear);
    cold_loss_.push_back(type.watt_per_nm2);
    paths_.push_back(HeatPathOf(type, heat_steps_ * dt));
  }
  for (const ParallelSpec& pair : spec.parallel) {
    parallel_.emplace_back(pair);
    TorqueCurve curve = curves_[Index(pair.pitch)];
    curve.limit /= 2;
    curves_[Index(pair.pitch)] = curves_[Index(pair.roll)] = curve;
  }
  loss_ = cold_loss_;
  Heat({});
}

std::span<const double> MotorBank::Step(const MotorInstant& now) {
  const std::span<const double> rate = now.rate.empty() ? now.dq : now.rate;
  supply_ = now.supply;
  Command(now);
  Limit(now, rate);
  KeepWithin(now.supply.most_power, rate);
  CountLosses(now.friction_w);
  if (++steps_ == heat_steps_) Heat(now.faults);
  return torque_;
}

// Sets torque_ to what is commanded: of the joints, but for pairs of their motors.
void MotorBank::Command(const MotorInstant& now) {
  const std::vector<MotorCommand>& commands = now.command.motors;
  for (std::size_t i = 0; i < torque_.size(); ++i) {
    MotorCommand motor = Scaled(commands[i], *motors_[i]);
    motor.kd *= kd_share_[i];
    motor.q = FollowedAngle(motor.q, motors_[i]->q_clamp);
    torque_[i] = DesiredTorque(motor, now.q[i], now.dq[i]);
  }
  for (const ParallelJoint& joint : parallel_) {
    const std::size_t pitch = Index(joint.pitch());
    const std::size_t roll = Index(joint.roll());
    ParallelJoint::Motors tau = joint.TorqueToMotors({torque_[pitch], torque_[roll]});
    if (commands[pitch].space == JointSpace::kMotors) {
      const ParallelJoint::Motors x = joint.ToMotors({now.q[pitch], now.q[roll]});
      const ParallelJoint::Motors v = joint.ToMotors({now.dq[pitch], now.dq[roll]});
      tau = {DesiredTorque(Scaled(commands[roll], *motors_[roll]), x.a, v.a),
             DesiredTorque(Scaled(commands[pitch], *motors_[pitch]), x.b, v.b)};
    }
    torque_[pitch] = tau.b;
    torque_[roll] = tau.a;
  }
}

// Limits torque_, and maps that of pairs to their joints.
void MotorBank::Limit(const MotorInstant& now, std::span<const double> rate) {
  std::ranges::copy(rate, rate_.begin());
  for (const ParallelJoint& joint : parallel_) {
    const std::size_t pitch = Index(joint.pitch());
    const std::size_t roll = Index(joint.roll());
    const ParallelJoint::Motors motors = joint.ToMotors({rate[pitch], rate[roll]});
    rate_[pitch] = motors.b;
    rate_[roll] = motors.a;
  }
  for (std::size_t i = 0; i < torque_.size(); ++i) {
    const double fault = now.faults.empty() ? 1 : now.faults[i].torque_share;
    const double volts = per_volt_[i] > 0 ? std::min(1.0, now.supply.voltage * per_volt_[i]) : 1.0;
    const bool works = now.supply.on && fault > 0;
    current_[i] =
        works ? AvailableTorque(curves_[i], torque_[i], rate_[i], volts, heat_share_[i]) : 0;
    torque_[i] = motors_[i]->strength * current_[i] * fault;
  }
  for (const ParallelJoint& joint : parallel_) {
    const std::size_t pitch = Index(joint.pitch());
    const std::size_t roll = Index(joint.roll());
    const ParallelJoint::Serial tau = joint.TorqueToSerial({torque_[roll], torque_[pitch]});
    torque_[pitch] = OfJoint(pitch, tau.pitch);
    torque_[roll] = OfJoint(roll, tau.roll);
  }
}

double MotorBank::OfJoint(std::size_t motor, double tau) const {
  const double limit = motors_[motor]->strength * motors_[motor]->torque_limit;
  return std::clamp(tau, -limit, limit);
}

// Takes the same share of every motor so that all of them take no more than `most`.
void MotorBank::KeepWithin(double most, std::span<const double> rate) {
  double work = 0;
  double loss = 0;
  for (std::size_t i = 0; i < torque_.size(); ++i) {
    const double own = own_share_[i] * current_[i];
    work += torque_[i] * rate[i];
    loss += loss_[i] * own * own;
  }
  power_ = work + loss;
  if (!std::isfinite(power_)) {  // of a world that diverges: the motors outlive it
    power_ = 0;
    std::ranges::fill(current_, 0);
    return;
  }
  if (power_ <= most) return;
  // The s of  loss s² + work s = most, in a form that has no difference of like numbers.
  const double root = std::sqrt(work * work + 4 * loss * most);
  const double share = work + root > 0 ? std::clamp(2 * most / (work + root), 0.0, 1.0) : 0.0;
  for (std::size_t i = 0; i < torque_.size(); ++i) {
    torque_[i] *= share;
    current_[i] *= share;
  }
  power_ = (loss * share + work) * share;
}

void MotorBank::CountLosses(std::span<const double> friction_w) {
  for (std::size_t i = 0; i < current_.size(); ++i) {
    const double own = own_share_[i] * current_[i];
    winding_w_[i] += loss_[i] * own * own;
  }
  for (std::size_t i = 0; i < friction_w.size(); ++i) {
    if (std::isfinite(friction_w[i])) casing_w_[i] += friction_w[i];
  }
}

// Brings the temperatures up to the end of the period, and what follows from them.
void MotorBank::Heat(std::span<const MotorEffects> faults) {
  const double rest_c = thermal_.ambient_c + thermal_.rest_rise_c;
  for (std::size_t i = 0; i < motors_.size(); ++i) {
    const HeatPath& path = paths_[i];
    const double winding_w = winding_w_[i] / heat_steps_;
    const double casing_w = casing_w_[i] / heat_steps_;
    const double casing = path.casing * (winding_w + casing_w);
    const double winding = casing + path.winding * winding_w;
    const double winding_off = winding_rise_[i] - winding;
    const double casing_off = casing_rise_[i] - casing;
    winding_rise_[i] = winding + path.decay[0] * winding_off + path.decay[1] * casing_off;
    casing_rise_[i] = casing + path.decay[2] * winding_off + path.decay[3] * casing_off;
    winding_w_[i] = casing_w_[i] = 0;
    Judge(i, rest_c, faults.empty() ? 0 : faults[i].heat_c);
  }
  steps_ = 0;
}

// Finds what the temperatures of a motor are with what faults add, and what they leave of it.
void MotorBank::Judge(std::size_t i, double rest_c, double fault_c) {
  winding_c_[i] = rest_c + winding_rise_[i] + fault_c;
  casing_c_[i] = rest_c + casing_rise_[i] + fault_c;
  loss_[i] = cold_loss_[i] * std::max(0.0, 1 + kCopper * (winding_c_[i] - kColdWinding_c));
  const double over = winding_c_[i] - thermal_.derate_c;
  const double room = thermal_.trip_c - thermal_.derate_c;
  const bool trips = winding_c_[i] >= thermal_.trip_c - (tripped(i) ? kCooled : 0);
  heat_share_[i] = trips ? 0 : over > 0 && room > 0 ? 1 - (1 - kShareAtTrip) * over / room : 1;
}

bool MotorBank::undervoltage(std::size_t motor) const {
  return !supply_.on || supply_.voltage < least_v_[motor];
}

}  // namespace understudy::robot
