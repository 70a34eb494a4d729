#include "motion/protection.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "motion/humanoid/fsm.h"

namespace understudy::motion {
namespace {

namespace goal = authority::goal;
using authority::MotionGoal;
using robot::Danger;
using robot::Protection;
using robot::ProtectionSpec;

constexpr double kFineFor = 0.5;  // s within its limit after which a danger is over. *assumed*

template <class... Goals>
bool IsOneOf(const MotionGoal& goal) {
  return (std::holds_alternative<Goals>(goal) || ...);
}

// Those that set something and move nothing.
bool IsSetting(const MotionGoal& goal) {
  return IsOneOf<goal::AutoRecovery, goal::SpeedLevel, goal::FootRaise, goal::KeepStepping,
                 goal::LastingMoves, goal::ResetEstimator>(goal);
}

// As seen on a Go2 (docs/reference/fidelity.md).
bool SparesCharge(const MotionGoal& goal) {
  return IsSetting(goal) || IsOneOf<goal::Damp, goal::StopMove, goal::RecoveryStand>(goal);
}

// What takes the load off the motors. *assumed*
bool Rests(const MotionGoal& goal) {
  const auto* fsm = std::get_if<goal::SetFsm>(&goal);
  return IsSetting(goal) || (fsm != nullptr && (fsm->id == 0 || fsm->id == 1)) ||
         IsOneOf<goal::Damp, goal::ZeroTorque, goal::StopMove, goal::StandDown>(goal);
}

// The motor of the body for which `of` is largest.
template <class Of>
DangerMeasure Largest(const DangerSenses& senses, const Of& of) {
  DangerMeasure most;
  for (std::size_t i = 0; i < senses.spec.motors.size(); ++i) {
    const double value = of(i, senses.sensed.motors[i]);
    if (value > most.value) most = {value, static_cast<std::int16_t>(i)};
  }
  return most;
}

DangerMeasure Tilt(const DangerSenses& senses) {
  const double up = (senses.sensed.imu.R_WI * senses.up_I).z();
  return {std::acos(std::clamp(up, -1.0, 1.0))};
}

DangerMeasure Overspeed(const DangerSenses& senses) {
  return Largest(senses, [&](std::size_t i, const robot::MotorReading& motor) {
    const double most = senses.spec.motors[i].no_load_speed;
    return most > 0 ? std::abs(motor.dq) / most : 0.0;
  });
}

DangerMeasure JointEnd(const DangerSenses& senses) {
  return Largest(senses, [&](std::size_t i, const robot::MotorReading& motor) {
    return std::max(senses.ranges[i][0] - motor.q, motor.q - senses.ranges[i][1]);
  });
}

DangerMeasure Heat(const DangerSenses& senses) {
  return Largest(senses,
                 [](std::size_t, const robot::MotorReading& motor) { return motor.winding_c; });
}

DangerMeasure Charge(const DangerSenses& senses) { return {senses.sensed.soc}; }

DangerMeasure Motor(const DangerSenses& senses) {
  return Largest(senses, [](std::size_t, const robot::MotorReading& motor) {
    return motor.silent || motor.encoder_error ? 1.0 : 0.0;
  });
}

DangerMeasure Remote(const DangerSenses& senses) { return {senses.remote_gone ? 1.0 : 0.0}; }

constexpr auto kRows = std::to_array<DangerRow>({
    {"tilt", "rad",
     "The base is tilted, as sensed, by more than limit rad, and the robot is not lying or getting "
     "up: it has fallen. A quadruped that is to recover by itself does then",
     &ProtectionSpec::tilt, Tilt},
    {"overspeed", "of its top speed",
     "A motor turns faster than limit times its no_load_speed: something drives it, or its encoder "
     "reads nonsense",
     &ProtectionSpec::overspeed, Overspeed},
    {"joint_end", "rad", "A joint reads more than limit rad beyond the end of its range",
     &ProtectionSpec::joint_end, JointEnd},
    {"heat", "°C",
     "A winding is hotter than limit °C. While it is, goals that load motors are refused",
     &ProtectionSpec::heat, Heat, false, Rests},
    {"charge", "",
     "The battery's charge is below limit, 0 to 1. While it is, all motion is refused but Damp, "
     "StopMove and RecoveryStand",
     &ProtectionSpec::charge, Charge, true, SparesCharge},
    {"motor", "",
     "A motor does not answer, or tells its encoder's error (limit 0). While it does, goals that "
     "load motors are refused",
     &ProtectionSpec::motor, Motor, false, Rests},
    {"remote", "",
     "Nothing is received any more of a remote controller whose sticks led the robot (limit 0)",
     &ProtectionSpec::remote, Remote},
});
static_assert(kRows.size() == robot::kDangers);

}  // namespace

std::span<const DangerRow> Dangers() { return kRows; }

ProtectedMotion::ProtectedMotion(const robot::RobotSpec& spec, const physics::RobotBody& body,
                                 std::unique_ptr<authority::Motion> motion)
    : spec_(spec), ranges_(body.ranges()), up_I_(body.imu_up()), motion_(std::move(motion)) {}

void ProtectedMotion::Start(const authority::MotionInput& input) {
  beyond_ = fine_ = {};
  dangers_ = {};
  led_by_sticks_ = false;
  motion_->Start(input);
}

authority::MotionVerdict ProtectedMotion::Ask(const authority::MotionGoal& goal) {
  for (std::size_t i = 0; i < kRows.size(); ++i) {
    const bool refuses = dangers_[i].does > Protection::kWarn && kRows[i].allows != nullptr;
    if (refuses && !kRows[i].allows(goal)) return authority::MotionVerdict::kNotNow;
  }
  return motion_->Ask(goal);
}

void ProtectedMotion::Step(const authority::MotionInput& input, double dt,
                           robot::RobotCommand* command) {
  const robot::RemoteReading& remote = input.remote;
  if (remote.there) {
    led_by_sticks_ = remote.lx != 0 || remote.ly != 0 || remote.rx != 0 || remote.ry != 0;
  }
  const DangerSenses senses{.spec = spec_,
                            .sensed = input,
                            .ranges = ranges_,
                            .up_I = up_I_,
                            .remote_gone = led_by_sticks_ && !remote.there};
  for (std::size_t i = 0; i < kRows.size(); ++i) {
    const DangerRow& row = kRows[i];
    const robot::ProtectionRule& rule = spec_.motion.protection.*row.rule;
    robot::DangerReading& danger = dangers_[i];
    if (rule.does == Protection::kNothing) continue;
    const DangerMeasure now = row.measure(senses);
    const bool beyond = row.below ? now.value < rule.limit : now.value > rule.limit;
    beyond_[i] = beyond ? beyond_[i] + dt : 0;
    if (beyond) {
      danger.value = now.value;
      danger.motor = now.motor;
    }
    fine_[i] = beyond ? 0 : fine_[i] + dt;
    if (fine_[i] > kFineFor) {
      danger.does = Protection::kNothing;
    } else if (beyond && danger.does == Protection::kNothing && beyond_[i] > rule.time &&
               Act(static_cast<Danger>(i), rule.does)) {
      danger.does = rule.does;
    }
  }
  motion_->Step(input, dt, command);
}

robot::MotionState ProtectedMotion::state() const {
  robot::MotionState state = motion_->state();
  state.dangers = dangers_;
  const int told = spec_.motion.humanoid.protection;
  if (told < 0 || state.id != robot::kDampingId) return state;
  const auto damps = [](const robot::DangerReading& one) { return one.does == Protection::kDamp; };
  if (std::ranges::any_of(dangers_, damps)) {
    state.id = told;
    state.name = "protection";
  }
  return state;
}

bool ProtectedMotion::Act(Danger danger, Protection does) {
  using authority::MotionVerdict;
  switch (does) {
    case Protection::kDamp: {
      MotionVerdict verdict = MotionVerdict::kUnable;
      if (danger == Danger::kTilt) verdict = motion_->Ask(goal::Fall{});
      if (verdict == MotionVerdict::kUnable) verdict = motion_->Ask(goal::Damp{});
      return verdict == MotionVerdict::kTaken;
    }
    case Protection::kLieDown:
      motion_->Ask(goal::StandDown{});
      return true;
    case Protection::kStop:
      motion_->Ask(goal::StopMove{});
      return true;
    case Protection::kWarn:
    case Protection::kNothing:
      break;
  }
  return true;
}

}  // namespace understudy::motion
