#include "emulator/computer.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "authority/onboard.h"
#include "robot/command_topics.h"
#include "robot/firmware.h"
#include "robot/hand_links.h"

namespace understudy::emulator {

Computer::Computer(const robot::RobotSpec& spec, const RobotSettings& settings, const Ports& ports,
                   const robot::FaultBank& faults, const robot::RobotCommand& start,
                   const authority::MotionMaker& make, double dt, RobotEvents* events)
    : spec_(spec),
      ports_(ports),
      faults_(faults),
      events_(events),
      step_ns_(std::llround(dt * 1e9)),
      service_rate_(spec.rates.service_hz, dt),
      topics_(robot::CommandTopicNames(spec)),
      first_service_(authority::StartService(spec, {})),
      power_(spec.boot),
      router_(spec, settings.gate, settings.motion, start, make),
      service_effects_(faults.effects().services),
      link_effects_(faults.effects().links),
      hand_effects_(faults.effects().hands),
      arrived_(router_.command()),
      tells_ranges_(robot::TellsRanges(spec)) {
  std::vector<std::string> links = topics_;
  std::ranges::copy(ports.topics->topics(), std::back_inserter(links));
  for (const robot::HandSpec& hand : spec.hands) {
    hand_links_.push_back(robot::HandLinks(hand, links));
  }
  if (robot::HasLidar(spec.lidar)) input_.obstacles = &seen_;
}

void Computer::Restart(const robot::RobotCommand& start) {
  router_.Restart(start);
  sampled_ = kNever;
}

void Computer::SwitchOff() {
  if (power_.state() == robot::PowerState::kOn) before_off_ = router_.owner().active();
  power_.SwitchOff();
  router_.GoLimp();
  Forget();
  ApplyFaults();
}

// Drops what was under way to and from the network, and what the sensors said: a part that does not
// answer after the next start reads 0.
void Computer::Forget() {
  ports_.topics->Clear();
  sampled_ = kNever;
  std::ranges::fill(state_.motors, robot::MotorReading{});
  std::ranges::fill(state_.foot_force, 0.0);
  state_.imu = state_.secondary_imu = {};
}

void Computer::SkipBoot() {
  if (power_.state() == robot::PowerState::kOn) return;
  power_.Skip();
  ApplyFaults();
  router_.owner().Select(before_off_);
}

// Services come up in their order, one after the other.
void Computer::StepPower(double t) {
  const bool booting = power_.state() == robot::PowerState::kBooting;
  if (power_.Step(t) && !router_.owner().onboard().silent) router_.owner().Select(first_service_);
  if (!booting) return;
  ApplyFaults();
  NoteChanges(t);
}

void Computer::ApplyFaults() {
  std::ranges::copy(faults_.effects().services, service_effects_.begin());
  for (std::size_t i = 0; i < service_effects_.size(); ++i) {
    service_effects_[i].absent = !power_.answers(i, service_effects_.size());
  }
  if (ports_.services != nullptr) ports_.services->ApplyFaults(service_effects_);
}

void Computer::ServeCalls(double t, time::Clock::Time now) {
  if (ports_.services == nullptr) return;
  const std::span<const services::Call> calls = ports_.services->Poll(&router_.owner(), now);
  for (const services::Call& call : calls) events_->AddCall(call, router_.owner().state().id);
  if (!calls.empty()) NoteChanges(t);
}

std::optional<std::int32_t> Computer::Call(std::string_view service, std::int64_t api_id,
                                           std::string_view parameter, time::Clock::Time now) {
  if (ports_.services == nullptr) return std::nullopt;
  const auto call = ports_.services->Answer(service, api_id, parameter, &router_.owner(), now);
  if (call) events_->AddCall(*call, router_.owner().state().id);
  return call ? std::optional(call->code) : std::nullopt;
}

// As on a real robot. Where their rates are equal the service gets the published samples, since it
// is due in the steps after those of that rate (and in the first, so that it moves the robot from
// the start). Nothing is sampled for it while no service is on.
bool Computer::NeedsSample(std::int64_t step) const {
  return ServiceDue(step) && router_.service_on() && sampled_ != step - 1;
}

const robot::RobotCommand& Computer::Command(std::int64_t step, double t) {
  const bool service_due = ServiceDue(step);
  input_.time = t;
  if (service_due && router_.service_on()) {
    input_.motors = state_.motors;
    input_.imu = state_.imu;
    input_.foot_force = state_.foot_force;
    input_.soc = state_.battery.soc;
    input_.arm_weight = router_.arm_weight(t);
    input_.remote = state_.remote;
  }
  return router_.Current(input_, service_due,
                         static_cast<double>(service_rate_.every() * step_ns_) * 1e-9);
}

robot::RobotState* Computer::BeginSample(std::int64_t step) {
  sampled_ = step;
  state_.tick_ms = (step * step_ns_ - since_ns()) / 1'000'000;
  state_.remote = ReadRemote(Time(step));
  state_.motion = router_.motion();
  return &state_;
}

void Computer::Publish(std::int64_t step) {
  if (!power_.computes()) return;
  if (ports_.services != nullptr && !silenced_) {
    ports_.services->Tell(router_.owner(), Time(step));
  }
  if (sampled_ != step) return;
  if (!silenced_) ports_.topics->Publish(state_, step);
  events_->AddNews(ports_.topics->TakeNews());
}

bool Computer::RunsLidar() const {
  return power_.computes() &&
         router_.owner().Runs(robot::IsMapped(spec_.lidar) ? authority::kLidarProgram
                                                           : authority::kLivoxProgram);
}

// Some need to know where the base is.
bool Computer::WantsLidar(wire::Content content) const {
  return !silenced_ && ports_.topics->ReadsLidar(content) &&
         (content < wire::Content::kCloudBase || router_.owner().state().estimates);
}

bool Computer::LooksForObstacles() const {
  if (!router_.owner().Runs(authority::kAvoidProgram)) return false;
  const robot::MotionState& motion = router_.owner().state();
  return motion.avoids || (tells_ranges_ && motion.estimates && router_.owner().avoids());
}

void Computer::See(const robot::SeenObstacles& seen) {
  seen_ = seen;
  if (tells_ranges_) state_.obstacle_ranges = robot::RangesOf(seen);
}

void Computer::Publish(wire::Content content, robot::LidarReading* reading) {
  reading->since_ns = since_ns();
  ports_.topics->PublishLidar(content, *reading);
}

void Computer::Silence(bool on) {
  if (on != silenced_) events_->Add(EventKind::kSilence, {on ? 1.0 : 0.0});
  silenced_ = on;
}

void Computer::Report(double t, Status* status) const {
  status->power = power_.state();
  status->boots_for = power_.boots_for();
  status->silenced = silenced_;
  status->gate = router_.gate().state();
  CopyText(router_.owner().active(), &status->motion_service);
  status->motion = router_.owner().state();
  status->arm_weight = router_.service_on() ? router_.arm_weight(t) : 0;
  status->hand_weight = router_.service_on() ? router_.hand_weight(t) : 0;
  status->remote = state_.remote;
  status->stick_wish = router_.stick_wish();
  status->commands = router_.counts(robot::kLowCmdTopic);
  status->arm_commands = router_.counts(robot::kArmSdkTopic);
  status->user_commands = router_.counts(robot::kUserLowCmdTopic);
  status->hand_commands = router_.counts(robot::kHandSdkTopic);
  status->port = ports_.topics->counts();
  status->command_writers = ports_.topics->command_writers();
  if (ports_.services != nullptr) status->services = ports_.services->counts();
  status->published = status->port.lowstates;
  for (std::size_t i = 0; i < spec_.hands.size(); ++i) {
    HandStatus& hand = status->hands[i];
    CopyText(spec_.hands[i].name, &hand.name);
    hand.commands = router_.counts(robot::kFirstHandTopic + i);
  }
}

}  // namespace understudy::emulator
