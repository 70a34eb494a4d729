#include "emulator/robot_events.h"

#include <algorithm>
#include <cmath>

namespace understudy::emulator {
namespace {

// °C below derate_c at which a motor is told to be cool again. *assumed*
constexpr double kCoolAgain = 5;

double Number(auto value) { return static_cast<double>(value); }

}  // namespace

RobotEvents::RobotEvents(const robot::RobotSpec& spec, std::uint8_t index,
                         const std::vector<std::string>& topics, EventRing* ring)
    : index_(index),
      thermal_(&spec.thermal),
      topics_(&topics),
      motors_(robot::AllMotors(spec)),
      ring_(ring),
      heat_(motors_.size()) {}

void RobotEvents::Begin(const Present& now) {
  const authority::MotorOwner& owner = now.router.owner();
  const robot::MotionState& motion = owner.state();
  if (now.hears) {
    service_ = owner.active();
    Add(EventKind::kMotionService, {}, *service_);
  }
  gate_ = now.router.gate().state();
  Add(EventKind::kGate, {Number(gate_)});
  motion_id_ = motion.id;
  motion_mode_ = motion.mode;
  motion_name_ = motion.name;
  Compare(now);
}

void RobotEvents::Compare(const Present& now) {
  const auto compare = [this](EventKind kind, auto* told, auto value) {
    if (*told == value) return;
    *told = value;
    Add(kind, {Number(value)});
  };
  const authority::MotorOwner& owner = now.router.owner();
  if (!now.hears) {
    service_.reset();
  } else if (owner.active() != service_) {
    service_ = owner.active();
    Add(EventKind::kMotionService, {}, *service_);
  }
  for (std::size_t topic = 0; topic < topics_->size(); ++topic) {
    const std::uint64_t timeouts = now.router.counts(topic).timeouts;
    if (timeouts == timeouts_[topic]) continue;
    timeouts_[topic] = timeouts;
    Add(EventKind::kTimeout, {}, (*topics_)[topic]);
  }
  compare(EventKind::kGate, &gate_, now.router.gate().state());
  if (now.power != power_) {
    power_ = now.power;
    Add(EventKind::kPower, {}, Name(power_));
  }
  const robot::MotionState& motion = owner.state();
  if (motion.id != motion_id_ || motion.mode != motion_mode_ || motion.name != motion_name_) {
    motion_id_ = motion.id;
    motion_mode_ = motion.mode;
    motion_name_ = motion.name;
    Add(EventKind::kMotion, {Number(motion.id), Number(motion.mode)}, motion.name);
  }
  CompareDangers(motion.dangers);
  compare(EventKind::kRemote, &keys_, now.keys);
  compare(EventKind::kCrane, &on_crane_, now.on_crane);
  compare(EventKind::kClamp, &clamped_, now.clamped);
}

void RobotEvents::CompareDangers(const std::array<robot::DangerReading, robot::kDangers>& dangers) {
  for (std::size_t i = 0; i < dangers.size(); ++i) {
    const robot::DangerReading& now = dangers[i];
    if (now.does == dangers_[i]) continue;
    const bool on = now.does != robot::Protection::kNothing;
    Add(EventKind::kProtection,
        {Number(i), on ? 1.0 : 0.0, now.value, Number(on ? now.does : dangers_[i])},
        now.motor < 0 ? std::string_view() : motors_[static_cast<std::size_t>(now.motor)]->joint);
    dangers_[i] = now.does;
  }
}

void RobotEvents::CompareHeat(const robot::MotorBank& motors) {
  for (std::size_t i = 0; i < heat_.size(); ++i) {
    const MotorHeat now = motors.tripped(i)   ? MotorHeat::kTripped
                          : motors.derated(i) ? MotorHeat::kDerated
                                              : MotorHeat::kFine;
    const double winding_c = motors.winding_c()[i];
    if (now == heat_[i]) continue;
    // A motor that works about the limit is not told of at every stride.
    if (now == MotorHeat::kFine && winding_c > thermal_->derate_c - kCoolAgain) continue;
    heat_[i] = now;
    Add(EventKind::kMotorHeat, {Number(now), winding_c}, motors_[i]->joint);
  }
}

void RobotEvents::CompareBattery(const robot::Battery& battery) {
  if (battery.cut_off() != cut_off_) {
    cut_off_ = battery.cut_off();
    Add(EventKind::kCutOff, {Number(cut_off_)});
  }
  // Told once on the way down: charge that comes back in a brake is not worth a line.
  if (!battery.low() || low_battery_) return;
  low_battery_ = true;
  Add(EventKind::kLowBattery, {battery.reading().soc});
}

void RobotEvents::AddCall(const services::Call& call, int state) {
  using services::CallRefusal;
  if (call.code != services::Call::kNoCode) {
    Add(EventKind::kCall, {Number(call.api_id), Number(call.code)}, call.service);
  }
  if (call.refusal == CallRefusal::kNone) return;
  std::string what(call.service);
  if (call.api_id != 0) what += " " + std::to_string(call.api_id);
  if (!call.name.empty()) what += " " + std::string(call.name);
  Add(EventKind::kCallRefused,
      {Number(call.refusal), Number(call.code), Number(state), Number(call.times)}, what);
}

void RobotEvents::AddCommand(std::size_t topic, robot::Refusal wire, robot::Refusal refusal,
                             const authority::GateCounts& counts) {
  const std::string& name = (*topics_)[topic];
  if (refusal != robot::Refusal::kNone) {
    Add(EventKind::kRefused, {Number(refusal)}, name);
    return;
  }
  if (counts.accepted == 1) Add(EventKind::kFollowing, {}, name);
  if (wire != robot::Refusal::kNone) Add(EventKind::kTolerated, {Number(wire)}, name);
}

void RobotEvents::AddTaken(const robot::RobotCommand& command, const robot::RobotState& state) {
  if (asked_) return;
  double jump = -1;
  std::size_t joint = 0;
  for (std::size_t i = 0; i < std::min(command.motors.size(), state.motors.size()); ++i) {
    const robot::MotorCommand& motor = command.motors[i];
    if (!robot::AsksForAngle(motor)) continue;
    // As the message has it, in single precision.
    const double off = std::abs(motor.q - static_cast<float>(state.motors[i].q));
    if (off <= jump) continue;
    jump = off;
    joint = i;
  }
  if (jump < 0) return;
  asked_ = true;
  Add(EventKind::kFirstCommand, {jump}, motors_[joint]->joint);
}

void RobotEvents::AddFault(const robot::FaultBank& bank, const robot::Fault& fault, bool on) {
  Add(EventKind::kFault,
      {Number(fault.kind - robot::FaultKinds().data()), on ? 1.0 : 0.0, fault.by},
      bank.components()[fault.component]);
}

void RobotEvents::AddNews(const robot::PortNews& news) {
  if (news.write_failures > 0) Add(EventKind::kWriteFailure, {Number(news.write_failures)});
  if (news.unused_slot) Add(EventKind::kUnusedSlot);
  if (news.unset_head) Add(EventKind::kUnsetHead);
  if (news.writers > 0) Add(EventKind::kWriters, {Number(news.writers)});
}

void RobotEvents::AddUnheeded(const authority::Unheeded& unheeded, const robot::MotionState& state,
                              std::string_view service) {
  const bool none = unheeded.reason == authority::Unheeded::Reason::kNoMotionService;
  Add(EventKind::kUnheeded,
      {Number(unheeded.reason), Number(unheeded.keys), Number(unheeded.wish), Number(state.id)},
      none ? service : state.name);
}

}  // namespace understudy::emulator
