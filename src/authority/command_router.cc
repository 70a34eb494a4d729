#include "authority/command_router.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "authority/onboard.h"

namespace understudy::authority {
namespace {

constexpr double kStickHold = 0.1;  // s, of a Move of the sticks, *assumed*; renewed each tick
// Of full deflection: less is rest. As in the vendor's gamepad.hpp; that robots do so is *assumed*.
constexpr double kStickRest = 0.01;

std::vector<Chord> ChordsOf(const robot::RobotSpec& spec) {
  std::vector<Chord> chords;
  for (std::size_t i = 0; i < spec.remote.chords.size(); ++i) {
    chords.push_back(MakeChord(spec.remote.chords[i], "robot.remote.chords." + std::to_string(i)));
  }
  return chords;
}

}  // namespace

CommandRouter::CommandRouter(const robot::RobotSpec& spec, const GateConfig& gate,
                             const MotionConfig& config, const robot::RobotCommand& start,
                             const MotionMaker& make)
    : fight_(config.fight),
      stick_speed_(spec.remote.speed),
      gate_(gate, start),
      user_gate_(gate, start),
      owner_(OnboardServices(spec, StartService(spec, config)),
             spec.kind == robot::RobotKind::kWheeled ? "1" : "0", make),
      arms_(OverArms(spec)),
      over_hands_(OverHands(spec)),
      hands_(spec.hands.begin(), spec.hands.end()),
      intakes_(robot::kMostCommandTopics, Intake(gate.lenient)),
      chords_(ChordsOf(spec)),
      own_(DampingCommand(spec.motors.size(), gate.damping_kd)),
      mixed_(own_),
      followed_{.motors = std::vector<robot::MotorCommand>(robot::AllMotors(spec).size())} {
  Restart(start);
}

void CommandRouter::Restart(const robot::RobotCommand& start) {
  gate_.Restart(start);
  owner_.Restart();
  arms_.Clear();
  over_hands_.Clear();
  for (HandGate& hand : hands_) hand.Restart();
  fought_ = fresh_lowcmd_ = false;
  was_on_ = service_on();
  if (was_on_ && !fight_) gate_.Close();
  Assemble(start, 0);
}

void CommandRouter::GoLimp() {
  owner_.Release();
  FollowOwner();
  gate_.OpenPassive(/*limp=*/true);
  for (HandGate& hand : hands_) hand.Restart();
}

void CommandRouter::Apply(const GateConfig& gate, const MotionConfig& config) {
  gate_.SetTimeout(gate.timeout);
  user_gate_.SetTimeout(gate.timeout);
  for (Intake& intake : intakes_) intake.SetLenient(gate.lenient);
  if (fight_ == config.fight) return;
  fight_ = config.fight;
  if (!service_on()) return;
  fought_ = fresh_lowcmd_ = false;
  fight_ ? gate_.OpenPassive() : gate_.Close();
}

robot::Refusal CommandRouter::Offer(std::size_t topic, const robot::RobotCommand& command,
                                    robot::Refusal form, double t) {
  FollowOwner();
  const auto offer = [&] {
    switch (topic) {
      case robot::kLowCmdTopic: {
        const robot::Refusal refusal = gate_.Offer(command, t);
        if (refusal == robot::Refusal::kNone) fresh_lowcmd_ = true;
        return refusal;
      }
      case robot::kArmSdkTopic:
        return service_on() ? arms_.Offer(command, t) : robot::Refusal::kNoMotionService;
      case robot::kUserLowCmdTopic:
        if (owner_.user_control()) return user_gate_.Offer(command, t);
        return service_on() ? robot::Refusal::kNotHandedOver : robot::Refusal::kNoMotionService;
      case robot::kHandSdkTopic:
        if (Damps()) return robot::Refusal::kDamping;
        return service_on() ? over_hands_.Offer(command, t) : robot::Refusal::kNoMotionService;
      default:
        return hands_[topic - robot::kFirstHandTopic].Offer(command, t);
    }
  };
  return intakes_[topic].Judge(form, offer);
}

GateCounts CommandRouter::counts(std::size_t topic) const {
  GateCounts counts = intakes_[topic].counts();
  const std::size_t hand = topic - robot::kFirstHandTopic;
  if (topic == robot::kLowCmdTopic) counts.timeouts = gate_.timeouts();
  if (topic == robot::kUserLowCmdTopic) counts.timeouts = user_gate_.timeouts();
  if (topic >= robot::kFirstHandTopic && hand < hands_.size()) {
    counts.timeouts = hands_[hand].timeouts();
  }
  return counts;
}

void CommandRouter::RunHands(std::span<const robot::HandEffects> faults, double t) {
  for (std::size_t i = 0; i < hands_.size(); ++i) hands_[i].SetRunning(!faults[i].dead, t);
}

void CommandRouter::Obey(const robot::RemoteReading& remote, double t) {
  FollowOwner();
  unheeded_.reset();
  ObeyKeys(remote, t);
  ObeySticks(remote);
}

void CommandRouter::ObeyKeys(const robot::RemoteReading& remote, double t) {
  using Reason = Unheeded::Reason;
  const bool released = !service_on();
  const int resting = gate_.state() == GateState::kLimp ? robot::kZeroTorqueId : robot::kDampingId;
  const Chord* chord = chords_.Read(remote.keys, released ? resting : owner_.state().id, t);
  const bool listens = gate_.state() == GateState::kFollowing;  // a program, to keys of its own
  if (chord == nullptr) {
    const Chord* const missed = chords_.missed();
    if (missed == nullptr || !missed->goal || (released && listens)) return;
    unheeded_ = {.reason = released ? Reason::kNoMotionService : Reason::kState,
                 .keys = remote.keys};
    return;
  }
  if (!chord->goal) {
    if (!released) owner_.Release();
    return FollowOwner();
  }
  if (!released) {
    const MotionVerdict verdict = owner_.Ask(*chord->goal);
    if (verdict == MotionVerdict::kTaken) return;
    const auto* fsm = std::get_if<goal::SetFsm>(&*chord->goal);
    unheeded_ = {
        .reason = verdict == MotionVerdict::kUnable ? Reason::kNotSimulated : Reason::kState,
        .keys = remote.keys,
        .wish = fsm == nullptr ? -1 : fsm->id};
  } else if (chords_.knows_debug() && std::holds_alternative<goal::ZeroTorque>(*chord->goal)) {
    gate_.OpenPassive(/*limp=*/true);
  } else if (chords_.knows_debug() && std::holds_alternative<goal::Damp>(*chord->goal)) {
    gate_.OpenPassive();
  } else if (!listens) {
    unheeded_ = {.reason = Reason::kNoMotionService, .keys = remote.keys};
  }
}

void CommandRouter::ObeySticks(const robot::RemoteReading& remote) {
  stick_wish_ = {};
  if (owner_.onboard().sticks) {
    const auto felt = [](double stick) { return std::abs(stick) < kStickRest ? 0 : stick; };
    stick_wish_ = {stick_speed_[0] * felt(remote.ly), -stick_speed_[1] * felt(remote.lx),
                   -stick_speed_[2] * felt(remote.rx)};
  }
  const bool moved = std::ranges::any_of(stick_wish_, [](double wish) { return wish != 0; });
  if ((moved || sticks_moved_) && service_on()) {
    const MotionVerdict verdict = owner_.Ask(goal::Move{.vx = stick_wish_[0],
                                                        .vy = stick_wish_[1],
                                                        .yaw_rate = stick_wish_[2],
                                                        .hold = kStickHold,
                                                        .by_sticks = true,
                                                        .avoids = owner_.avoids()});
    if (moved && verdict != MotionVerdict::kTaken && !sticks_unheeded_) {
      sticks_unheeded_ = true;
      unheeded_ = {.reason = verdict == MotionVerdict::kUnable ? Unheeded::Reason::kNotSimulated
                                                               : Unheeded::Reason::kState};
    }
  }
  if (!moved) sticks_unheeded_ = false;
  sticks_moved_ = moved;
}

const robot::RobotCommand& CommandRouter::Current(const MotionInput& input, bool service_due,
                                                  double dt) {
  Assemble(OfBody(input, service_due, dt), input.time);
  return followed_;
}

void CommandRouter::Assemble(const robot::RobotCommand& body, double t) {
  auto next = std::ranges::copy(body.motors, followed_.motors.begin()).out;
  for (HandGate& hand : hands_) next = std::ranges::copy(hand.Current(t).motors, next).out;
  if (Damps()) over_hands_.Clear();
  over_hands_.MixOver(t, std::span(followed_.motors).subspan(body.motors.size()));
}

const robot::RobotCommand& CommandRouter::OfBody(const MotionInput& input, bool service_due,
                                                 double dt) {
  FollowOwner();
  if (!service_on()) return gate_.Current(input.time);
  if (service_due) {
    owner_.Step(input, dt, &own_);
    fought_ = false;
  }
  if (std::exchange(fresh_lowcmd_, false)) fought_ = true;
  if (fought_) return gate_.Current(input.time);
  if (owner_.user_control() && user_gate_.state() != GateState::kStart) {
    return user_gate_.Current(input.time);
  }
  if (arms_.weight(input.time) <= 0) return own_;
  mixed_ = own_;
  arms_.MixOver(input.time, mixed_.motors);
  return mixed_;
}

void CommandRouter::FollowOwner() {
  if (owner_.user_control() != was_user_) {
    was_user_ = owner_.user_control();
    user_gate_.Restart();
  }
  if (service_on() == was_on_) return;
  was_on_ = service_on();
  arms_.Clear();
  over_hands_.Clear();
  fought_ = fresh_lowcmd_ = false;
  if (was_on_ && !fight_) {
    gate_.Close();
  } else {
    gate_.OpenPassive();
  }
}

}  // namespace understudy::authority
