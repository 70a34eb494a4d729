// Carries out the requests of the script and of the inbox.
#include <utility>

#include "base/errors.h"
#include "emulator/world.h"

namespace understudy::emulator {

void World::Play(std::vector<ScriptEvent> script) {
  for (const ScriptEvent& event : script) {
    if (auto fits = CheckNames(event.request); !fits) {
      throw ConfigError(event.where + ": " + fits.why());
    }
  }
  script_ = std::move(script);
}

void World::FollowScript(double t) {
  // Half a step of tolerance: an event at 0.3 s belongs to the step of 0.3 s in spite of rounding.
  const double now = t + 0.5 * physics_.timestep();
  for (; script_next_ < script_.size() && script_[script_next_].at <= now; ++script_next_) {
    ScriptEvent& event = script_[script_next_];
    events_.Add(EventKind::kScript, 0, {static_cast<double>(script_next_)}, event.where);
    const Answer answer = CarryOut(&event.request, t);
    if (answer) continue;
    ++script_refused_;
    events_.Add(EventKind::kScriptRefused, 0, {}, event.where + ": " + answer.why());
  }
}

void World::TakeRequests() {
  AnswerSteppers();
  inbox_->Drain(now_, [this](Request* request, Reply* reply) -> std::optional<Answer> {
    const std::size_t dragged = drags_.size();
    Answer answer = CarryOut(request, time());
    if (!answer) return answer;
    // A drag is renewed many times a second; only the first one is an event.
    const bool renews = request->row->name == "drag" && drags_.size() == dragged;
    if (request->row->noted && !renews) {
      events_.Append({.step = step_,
                      .time = time(),
                      .kind = EventKind::kRequest,
                      .robot = static_cast<std::uint8_t>(request->robot),
                      .request = *request});
    }
    if (request->waits()) {
      steppers_.push_back({.step = step_ + pace_.steps_left, .reply = std::move(*reply)});
      return std::nullopt;
    }
    return answer;
  });
}

Answer World::CarryOut(Request* request, double t) {
  if (request->robot >= robots_.size()) return CheckNames(*request);
  Robot& robot = robots_[request->robot];
  Answer answer = request->row->carry_out(*this, robot, *request, t);
  if (pace_.paused != noted_.paused) {
    events_.Add(EventKind::kPause, 0, {pace_.paused ? 1.0 : 0.0});
  }
  if (pace_.speed != noted_.speed) events_.Add(EventKind::kSpeed, 0, {pace_.speed});
  noted_ = {.paused = pace_.paused, .speed = pace_.speed};
  robot.NoteChanges(t);
  return answer;
}

// A pause cancels the remaining steps.
void World::AnswerSteppers() {
  std::erase_if(steppers_, [this](Stepper& stepper) {
    if (step_ >= stepper.step) {
      stepper.reply.Give({});
    } else if (pace_.stands_still()) {
      stepper.reply.Give(Error{"the robot was paused before all steps were made"});
    } else {
      return false;
    }
    return true;
  });
}

}  // namespace understudy::emulator
