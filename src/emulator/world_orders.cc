// What the world does about orders, whether they come from people or from a script.
#include <algorithm>
#include <utility>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "emulator/world.h"
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

void World::Play(std::vector<ScriptEvent> script) {
  for (const ScriptEvent& event : script) {
    const auto* push = std::get_if<PushBody>(&event.order);
    if (push == nullptr || push->body.empty()) continue;
    const int body = physics_.FindBody(push->body);
    if (body < 0) throw ConfigError(event.where + ": body: " + NoBody(physics_, push->body));
    if (body == 0) throw ConfigError(event.where + ": body: '" + push->body + "' does not move");
  }
  script_ = std::move(script);
}

void World::FollowScript(double t) {
  // Half a step of grace: an event at 0.3 s belongs to the step of 0.3 s whatever either rounds to.
  const double now = t + 0.5 * physics_.timestep();
  for (; script_next_ < script_.size() && script_[script_next_].at <= now; ++script_next_) {
    const ScriptEvent& event = script_[script_next_];
    const Answer answer = CarryOut(event.order);
    if (answer.empty()) continue;
    ++script_refused_;
    script_refusal_ = event.where + ": " + answer;
  }
}

void World::TakeOrders() {
  inbox_->Drain([this](const Order& order) {
    const std::size_t dragged = drags_.size();
    Answer answer = CarryOut(order);
    // Who drags says so many times a second; the first time counts.
    const bool renews = std::holds_alternative<DragBody>(order) && drags_.size() == dragged;
    if (answer.empty() && !renews) {
      orders_.Add(NoteOf(order, time(), robot().spec().base_body, robot().start_pose()));
    }
    return answer;
  });
}

Answer World::CarryOut(const Order& order) {
  const double t = time();
  Robot& robot = this->robot();
  const Overloaded carry_out{
      [&robot](const LowerCrane& lower) -> Answer {
        if (!robot.crane().attached()) return "the robot does not hang from the crane";
        robot.crane().Lower(lower.by);
        return {};
      },
      [&robot](const AttachCrane&) -> Answer {
        robot.AttachCrane();
        return {};
      },
      [&robot](const ReleaseCrane&) -> Answer {
        robot.crane().Release();
        return {};
      },
      [this](const ClampBase& clamp) -> Answer {
        physics_.Clamp(clamp.on);
        return {};
      },
      [this, &robot](const ResetRobot& reset) -> Answer {
        Reset(&robot, reset.pose.value_or(robot.start_pose()));
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
      [&robot, t](const PressRemote& press) -> Answer {
        robot.remote().Press(press, t);
        return {};
      },
      [&robot](const HoldRemote& hold) -> Answer {
        robot.remote().Hold(hold);
        return {};
      },
      [&robot](const ReleaseRemote& release) -> Answer {
        robot.remote().Release(release);
        return {};
      },
      [&robot, t](const MoveSticks& move) -> Answer {
        robot.remote().Move(move, t);
        return {};
      },
      [&robot, t](const SetRemote& set) -> Answer {
        robot.remote().Set(set, t);
        return {};
      },
      [&robot](const SwitchRemote& change) -> Answer {
        robot.remote().Switch(change);
        return {};
      },
  };
  return std::visit(carry_out, order);
}

Answer World::BeginPush(const PushBody& push) {
  const std::string& name = push.body.empty() ? robot().spec().base_body : push.body;
  const int body = physics_.FindBody(name);
  if (body < 0) return NoBody(physics_, name);
  if (body == 0) return "'" + name + "' does not move";
  // However short it is told to be, it acts in one step.
  const double until = time() + std::max(push.seconds, physics_.timestep());
  if (!pushes_.Begin(body, push.force, until)) {
    return "as many pushes as there can be are under way";
  }
  return {};
}

Answer World::Drag(const DragBody& drag) {
  const int body = physics_.FindBody(drag.body);
  if (body < 0) return NoBody(physics_, drag.body);
  if (body == 0) return "'" + drag.body + "' does not move";
  const double until = time() + std::max(drag.seconds, physics_.timestep());
  if (!drags_.Pull(body, drag.p_BP, drag.p_WT, until)) {
    return "as many bodies as there can be are dragged";
  }
  return {};
}

Answer World::EndDrag(const ReleaseDrag& release) {
  if (release.body.empty()) {
    drags_.Clear();
    return {};
  }
  const int body = physics_.FindBody(release.body);
  if (body < 0) return NoBody(physics_, release.body);
  drags_.Release(body);
  return {};
}

Answer World::MakeSteps(const StepRun& step) {
  if (!pace_.paused) return "the robot is not paused";
  pace_.steps_left += step.steps;
  return {};
}

}  // namespace understudy::emulator
