// What the emulator does about orders, whether they come from people or from a script.
#include <algorithm>
#include <utility>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "emulator/emulator.h"
#include "physics/world_reading.h"

namespace understudy::emulator {
namespace {

template <class... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

std::string NoBody(const physics::PhysicsWorld& world, const std::string& name) {
  const std::string nearest = NearestWord(name, physics::BodyNames(world));
  const std::string hint = nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
  return "the model has no body '" + name + "'" + hint;
}

}  // namespace

void Emulator::Play(std::vector<ScriptEvent> script) {
  for (const ScriptEvent& event : script) {
    const auto* push = std::get_if<PushBody>(&event.order);
    if (push == nullptr || push->body.empty()) continue;
    const int body = world_.FindBody(push->body);
    if (body < 0) throw ConfigError(event.where + ": body: " + NoBody(world_, push->body));
    if (body == 0) throw ConfigError(event.where + ": body: '" + push->body + "' does not move");
  }
  script_ = std::move(script);
}

void Emulator::FollowScript(double t) {
  // Half a step of grace: an event at 0.3 s belongs to the step of 0.3 s whatever either rounds to.
  const double now = t + 0.5 * world_.timestep();
  for (; script_next_ < script_.size() && script_[script_next_].at <= now; ++script_next_) {
    const ScriptEvent& event = script_[script_next_];
    const Answer answer = CarryOut(event.order);
    if (answer.empty()) continue;
    ++script_refused_;
    script_refusal_ = event.where + ": " + answer;
  }
}

void Emulator::TakeOrders() {
  inbox_->Drain([this](const Order& order) {
    const std::size_t dragged = drags_.size();
    Answer answer = CarryOut(order);
    // Who drags says so many times a second; the first time counts.
    const bool renews = std::holds_alternative<DragBody>(order) && drags_.size() == dragged;
    if (answer.empty() && !renews) {
      orders_.Add(NoteOf(order, time(), config_.robot.base_body, start_pose_));
    }
    return answer;
  });
}

Answer Emulator::CarryOut(const Order& order) {
  const double t = time();
  const Overloaded carry_out{
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
      [this](const ResetRobot& reset) -> Answer {
        To(starts_[static_cast<std::size_t>(reset.pose.value_or(start_pose_))]);
        return {};
      },
      [this](const PushBody& push) -> Answer { return BeginPush(push); },
      [this](const DragBody& drag) -> Answer { return Drag(drag); },
      [this](const ReleaseDrag& release) -> Answer { return EndDrag(release); },
      [this](const PauseRun& pause) -> Answer {
        pace_.paused = pause.on;
        pace_.steps_left = 0;
        return {};
      },
      [this](const StepRun& step) -> Answer { return MakeSteps(step); },
      [this](const SetSpeed& set) -> Answer {
        pace_.speed = set.speed;
        return {};
      },
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
      [this, t](const SetRemote& set) -> Answer {
        remote_.Set(set, t);
        return {};
      },
      [this](const SwitchRemote& change) -> Answer {
        remote_.Switch(change);
        return {};
      },
  };
  return std::visit(carry_out, order);
}

Answer Emulator::BeginPush(const PushBody& push) {
  const std::string& name = push.body.empty() ? config_.robot.base_body : push.body;
  const int body = world_.FindBody(name);
  if (body < 0) return NoBody(world_, name);
  if (body == 0) return "'" + name + "' does not move";
  // However short it is told to be, it acts in one step.
  const double until = time() + std::max(push.seconds, world_.timestep());
  if (!pushes_.Begin(body, push.force, until)) {
    return "as many pushes as there can be are under way";
  }
  return {};
}

Answer Emulator::Drag(const DragBody& drag) {
  const int body = world_.FindBody(drag.body);
  if (body < 0) return NoBody(world_, drag.body);
  if (body == 0) return "'" + drag.body + "' does not move";
  const double until = time() + std::max(drag.seconds, world_.timestep());
  if (!drags_.Pull(body, drag.p_BP, drag.p_WT, until)) {
    return "as many bodies as there can be are dragged";
  }
  return {};
}

Answer Emulator::EndDrag(const ReleaseDrag& release) {
  if (release.body.empty()) {
    drags_.Clear();
    return {};
  }
  const int body = world_.FindBody(release.body);
  if (body < 0) return NoBody(world_, release.body);
  drags_.Release(body);
  return {};
}

Answer Emulator::MakeSteps(const StepRun& step) {
  if (!pace_.paused) return "the robot is not paused";
  pace_.steps_left += step.steps;
  return {};
}

}  // namespace understudy::emulator
