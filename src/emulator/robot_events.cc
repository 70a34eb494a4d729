#include "emulator/robot_events.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace understudy::emulator {
namespace {

// °C below derate_c at which a motor is reported cool again. *assumed*
constexpr double kCoolAgain = 5;

// Adds `more` to a text that ends with a zero; cut to fit.
template <std::size_t kRoom>
void Append(std::string_view more, std::array<char, kRoom>* text) {
  const std::size_t used = std::strlen(text->data());
  more.copy(text->data() + used, kRoom - 1 - used);
}

double Number(auto value) { return static_cast<double>(value); }

}  // namespace

RobotEvents::RobotEvents(const robot::RobotSpec& spec, std::uint8_t index, EventRing* ring)
    : index_(index),
      thermal_(&spec.thermal),
      topics_(robot::CommandTopicNames(spec)),
      motors_(robot::AllMotors(spec)),
      ring_(ring),
      heat_(motors_.size()) {
  moved_.resize(topics_.size());
  for (std::size_t i = 0; i < spec.motors.size(); ++i) {
    const robot::MotorSpec& motor = spec.motors[i];
    moved_[robot::kLowCmdTopic].push_back({i, &motor});
    moved_[robot::kUserLowCmdTopic].push_back({i, &motor});
    if (std::ranges::count(spec.arm_sdk.slots, motor.slot) > 0) {
      moved_[robot::kArmSdkTopic].push_back({i, &motor});
    }
  }
  std::size_t of_hands = 0;
  for (std::size_t hand = 0; hand < spec.hands.size(); ++hand) {
    const std::vector<robot::MotorSpec>& motors = spec.hands[hand].motors;
    for (std::size_t i = 0; i < motors.size(); ++i, ++of_hands) {
      moved_[robot::kFirstHandTopic + hand].push_back({i, &motors[i]});
      if (spec.hands[hand].sdk_slot >= 0) {
        moved_[robot::kHandSdkTopic].push_back({of_hands, &motors[i]});
      }
    }
  }
}

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
  const authority::MotorOwner& owner = now.router.owner();
  if (!now.hears) {
    service_.reset();
  } else if (owner.active() != service_) {
    service_ = owner.active();
    Add(EventKind::kMotionService, {}, *service_);
  }
  for (std::size_t topic = 0; topic < topics_.size(); ++topic) {
    const std::uint64_t timeouts = now.router.counts(topic).timeouts;
    if (timeouts == timeouts_[topic]) continue;
    timeouts_[topic] = timeouts;
    Add(EventKind::kTimeout, {}, topics_[topic]);
  }
  CompareValue(EventKind::kGate, now.router.gate().state(), &gate_);
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
  CompareValue(EventKind::kRemote, now.keys, &keys_);
}

void RobotEvents::CompareHolds(bool on_crane, bool clamped) {
  CompareValue(EventKind::kCrane, on_crane, &on_crane_);
  CompareValue(EventKind::kClamp, clamped, &clamped_);
}

template <class Value>
void RobotEvents::CompareValue(EventKind kind, Value now, Value* last) {
  if (*last == now) return;
  *last = now;
  Add(kind, {Number(now)});
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
  const std::string& name = topics_[topic];
  if (refusal != robot::Refusal::kNone) {
    Add(EventKind::kRefused, {Number(refusal)}, name);
    return;
  }
  if (counts.accepted == 1) Add(EventKind::kFollowing, {}, name);
  if (wire != robot::Refusal::kNone) Add(EventKind::kTolerated, {Number(wire)}, name);
}

void RobotEvents::AddTaken(std::size_t topic, const robot::RobotCommand& command,
                           const robot::RobotState& state) {
  if (topic == robot::kLowCmdTopic && !asked_) AddJump(command, state);
  AddUnheld(topic, command);
}

void RobotEvents::AddUnheld(std::size_t topic, const robot::RobotCommand& command) {
  std::vector<Moved>& moved = moved_[topic];
  const bool weighted = topic == robot::kArmSdkTopic || topic == robot::kHandSdkTopic;
  if (weighted && command.weight <= 0) return;
  const auto of = [&](const Moved& one) { return command.motors[one.index]; };
  if (std::ranges::none_of(moved, [&](const Moved& one) { return of(one).kp > 0; })) return;
  std::size_t unheld = 0;
  std::array<char, sizeof(Event::text)> which{};
  for (const Moved& one : moved) {
    const robot::MotorCommand motor = of(one);
    if (!motor.enabled || motor.kp > 0 || motor.tau != 0 || (!weighted && motor.kd > 0)) continue;
    if (++unheld > kMostNamed) continue;
    Append(unheld == 1 ? topics_[topic] : ",", &which);
    Append(unheld == 1 ? ": " : " ", &which);
    Append(one.motor->joint, &which);
  }
  if (unheld == 0) return;
  Add(EventKind::kUnheld, {Number(unheld)}, which.data());
  moved.clear();
}

void RobotEvents::AddJump(const robot::RobotCommand& command, const robot::RobotState& state) {
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
