// Carries out the requests of the script and of the inbox.
#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "base/errors.h"
#include "base/overloaded.h"
#include "emulator/live_settings.h"
#include "emulator/world.h"

namespace understudy::emulator {

void World::Play(std::vector<ScriptEvent> script, std::unique_ptr<ScriptConditions> conditions) {
  for (const ScriptEvent& event : script) {
    if (auto fits = CheckNames(event.request); !fits) {
      throw ConfigError(event.where + ": " + fits.why());
    }
  }
  script_ = std::move(script);
  conditions_ = std::move(conditions);
  script_turns_.reserve(script_.size());
}

// Half a step of tolerance: an event at 0.3 s belongs to the step of 0.3 s in spite of rounding.
double World::Latest(double t) const { return t + 0.5 * physics_.timestep(); }

void World::FollowScript(double t) {
  if (script_done_ == script_.size()) return;
  const double now = Latest(t);
  while (script_next_ < script_.size() && script_[script_next_].at <= now) {
    script_turns_.push_back({.event = script_next_, .since = script_[script_next_].at});
    do {
      ++script_next_;
    } while (script_next_ < script_.size() && script_[script_next_].after);
  }
  if (conditions_ != nullptr) {
    conditions_->Look(*this, std::ranges::any_of(script_turns_, [&](const ScriptTurn& turn) {
      return script_[turn.event].when.has_value();
    }));
  }
  for (std::size_t i = 0; i < script_turns_.size();) {
    ScriptTurn& turn = script_turns_[i];
    if (!FinishEvent(turn, t)) {
      ++i;
      continue;
    }
    ++script_done_;
    ++turn.event;
    if (turn.event < script_.size() && script_[turn.event].after) {
      turn.since = t + script_[turn.event].at;
    } else {
      script_turns_.erase(script_turns_.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
}

// Carries out or refuses the event whose turn it is. Returns false if it is not over.
bool World::FinishEvent(const ScriptTurn& turn, double t) {
  ScriptEvent& event = script_[turn.event];
  const double now = Latest(t);
  if (turn.since > now) return false;
  const auto number = static_cast<double>(turn.event);
  if (event.when) {
    const bool holds = conditions_->Holds(*event.when);
    if (!holds && now < turn.since + event.within) return false;
    const double waited = std::max(0.0, t - turn.since);
    events_.Add(EventKind::kScriptWait, 0, {number, waited, holds ? 1.0 : 0.0}, event.condition);
    if (!holds) {
      RefuseEvent(event, "timed out after " + NumberText(event.within) + " s: " + event.condition);
      return true;
    }
  }
  events_.Add(EventKind::kScript, 0, {number}, event.where);
  if (const Answer answer = CarryOut(&event.request, t); !answer) RefuseEvent(event, answer.why());
  return true;
}

void World::RefuseEvent(const ScriptEvent& event, const std::string& why) {
  ++script_refused_;
  events_.Add(EventKind::kScriptRefused, 0, {}, event.where + ": " + why);
}

std::size_t World::drag_count() const {
  std::size_t count = 0;
  for (const Forces& forces : forces_) count += forces.drags.size();
  return count;
}

void World::TakeRequests() {
  AnswerSteppers();
  for (RecordingDesk& desk : recordings_) desk.GiveAnswer();
  for (Inbox* inbox : inboxes_) {
    inbox->Drain([this](Request* request, Reply* reply) { return TakeRequest(request, reply); });
  }
}

// Returns nullopt if the answer comes later.
std::optional<Answer> World::TakeRequest(Request* request, Reply* reply) {
  const std::size_t dragged = drag_count();
  Answer answer = CarryOut(request, time());
  if (!answer) return answer;
  // A drag is renewed many times a second; only the first one is an event.
  const bool renews = request->row->name == "drag" && drag_count() == dragged;
  const bool of_all = request->row->name == "reset" && request->on("all");
  for (std::size_t i = 0; i < robots_.size() && request->row->noted && !renews; ++i) {
    if (!of_all && i != request->robot) continue;
    events_.Append({.step = step_,
                    .time = time(),
                    .kind = EventKind::kRequest,
                    .robot = static_cast<std::uint8_t>(i),
                    .request = *request});
  }
  if (!request->waits()) return answer;
  if (request->row->name == "step") {
    steppers_.push_back({.step = step_ + pace_.steps_left, .reply = std::move(*reply)});
  } else {
    recordings_[request->robot].Keep(std::move(*reply));
  }
  return std::nullopt;
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

Result<double> World::SettingOf(const Request& request) const {
  const auto setting = FindSetting(request.name());
  if (!setting) return setting.error();
  if (settings_.keys.empty()) return Error{"this world has no settings"};
  return SettingNumber(settings_.keys[*setting], request);
}

double World::Setting(std::size_t setting, const Robot& robot) const {
  // What is not const is only read.
  const auto value = LiveSettings()[setting].at(const_cast<WorldSettings&>(settings_),
                                                const_cast<RobotSettings&>(robot.settings()));
  return std::visit(Overloaded{[](const bool* is) { return *is ? 1.0 : 0.0; },
                               [](const double* number) { return *number; }},
                    value);
}

Answer World::Set(Robot* robot, const Request& request) {
  const auto value = SettingOf(request);
  if (!value) return value.error();
  const std::size_t setting = *FindSetting(request.name());
  const double before = Setting(setting, *robot);
  if (*value == before) return {};
  std::visit(
      Overloaded{[&](bool* is) { *is = *value != 0; }, [&](double* number) { *number = *value; }},
      LiveSettings()[setting].at(settings_, robot->settings()));
  robot->FollowSettings();
  physics_.SetGroundFriction(settings_.ground_friction);
  const schema::Entry& key = settings_.keys[setting];
  std::array<char, sizeof(Event::text)> text{};
  if (key.words.empty() && before == 0 && key.key == "terrain.friction") {
    // 0 is none for all: every patch has its own, and the floor that of the robot's model.
    std::snprintf(text.data(), text.size(), "%s: %.6g, before each patch's own", key.key.c_str(),
                  *value);
  } else if (key.words.empty()) {
    std::snprintf(text.data(), text.size(), "%s: %.6g%s%s, before %.6g", key.key.c_str(), *value,
                  key.unit.empty() ? "" : " ", key.unit.c_str(), before);
  } else {
    std::snprintf(text.data(), text.size(), "%s: %s", key.key.c_str(),
                  key.words[static_cast<std::size_t>(*value)].c_str());
  }
  events_.Add(EventKind::kSetting, static_cast<std::uint8_t>(request.robot), {*value, before},
              text.data());
  return {};
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
