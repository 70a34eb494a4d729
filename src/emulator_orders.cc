// What the emulator does about orders, whether they come from people or from a script.
#include <utility>

#include "emulator.h"
#include "robot/errors.h"

namespace understudy {
namespace {

template <class... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

}  // namespace

void Emulator::Play(std::vector<ScriptEvent> script) {
  for (const ScriptEvent& event : script) {
    const auto* push = std::get_if<PushBody>(&event.order);
    if (push != nullptr && !push->body.empty() && world_.FindBody(push->body) < 0) {
      throw ConfigError(event.where + ": body: the model has no body '" + push->body + "'");
    }
  }
  script_ = std::move(script);
}

void Emulator::TakeOrders(double t) {
  // Half a step of grace: an event at 0.3 s belongs to the step of 0.3 s whatever either rounds to.
  const double now = t + 0.5 * world_.timestep();
  for (; script_next_ < script_.size() && script_[script_next_].at <= now; ++script_next_) {
    const ScriptEvent& event = script_[script_next_];
    const Answer answer = CarryOut(event.order);
    if (answer.empty()) continue;
    ++script_refused_;
    script_refusal_ = event.where + ": " + answer;
  }
  inbox_->Drain([this](const Order& order) { return CarryOut(order); });
}

Answer Emulator::CarryOut(const Order& order) {
  const double t = time();
  return std::visit(Overloaded{
                        [this](const LowerCrane& lower) -> Answer {
                          if (!crane_.attached()) return "the robot does not hang from the crane";
                          crane_.Lower(lower.by);
                          return {};
                        },
                        [this](const AttachCrane&) -> Answer {
                          HangFromCrane();
                          return {};
                        },
                        [this](const ReleaseCrane&) -> Answer {
                          crane_.Release();
                          return {};
                        },
                        [this](const ClampBase& clamp) -> Answer {
                          world_.Clamp(clamp.on);
                          return {};
                        },
                        [this](const ResetRobot&) -> Answer {
                          ToStart();
                          return {};
                        },
                        [this](const PushBody& push) -> Answer { return BeginPush(push); },
                        [this, t](const PressRemote& press) -> Answer {
                          remote_.Press(press, t);
                          return {};
                        },
                        [this](const HoldRemote& hold) -> Answer {
                          remote_.Hold(hold);
                          return {};
                        },
                        [this](const ReleaseRemote& release) -> Answer {
                          remote_.Release(release);
                          return {};
                        },
                        [this, t](const MoveSticks& move) -> Answer {
                          remote_.Move(move, t);
                          return {};
                        },
                        [this](const SwitchRemote& change) -> Answer {
                          remote_.Switch(change);
                          return {};
                        },
                    },
                    order);
}

Answer Emulator::BeginPush(const PushBody& push) {
  const std::string& name = push.body.empty() ? config_.robot.base_body : push.body;
  const int body = world_.FindBody(name);
  if (body < 0) return "the model has no body '" + name + "'";
  if (pushes_.size() >= kMostPushes) return "as many pushes as there can be are under way";
  // Acts in all steps that begin before the end.
  pushes_.push_back({.body = body,
                     .force_W = push.force,
                     .until = time() + push.seconds - 1.5 * world_.timestep()});
  return {};
}

}  // namespace understudy
