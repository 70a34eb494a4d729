#include "emulator/world.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace understudy::emulator {
namespace {

// The most requests that wait for their steps: one for each client of the server.
constexpr std::size_t kMostSteppers = 2 * Inbox::kCapacity;

}  // namespace

World::World(physics::MujocoWorld physics, const WorldSettings& settings,
             const std::vector<RobotParts>& robots, Inbox* inbox)
    : settings_(settings),
      physics_(std::move(physics)),
      inboxes_{inbox},
      step_ns_(std::llround(physics_.timestep() * 1e9)),
      pace_{.speed = settings.speed} {
  const auto sees = [](const RobotParts& parts) { return robot::HasLidar(parts.spec.lidar); };
  if (std::ranges::any_of(robots, sees)) {
    rays_.emplace(physics_.model(), physics_.data(), physics_.scan());
  }
  for (const RobotParts& parts : robots) {
    robots_.emplace_back(parts, static_cast<std::uint8_t>(robots_.size()), &physics_,
                         rays_ ? &*rays_ : nullptr, &events_);
  }
  forces_.resize(robots.size());
  recordings_.resize(robots.size());
  steppers_.reserve(kMostSteppers);
  noted_ = {.paused = pace_.paused, .speed = pace_.speed};
}

physics::StepHealth World::Tick(time::Clock::Time now) {
  const double t = time();
  now_ = now;
  FollowScript(t);
  Attend(now);
  for (Robot& robot : robots_) robot.Hear(step_, t);

  physics_.BeginStep();
  for (Forces& forces : forces_) {
    forces.pushes.Act(t, &physics_);
    forces.drags.Act(t, &physics_);
  }
  for (Robot& robot : robots_) robot.Act();
  const physics::StepHealth health = physics_.EndStep();

  if (health == physics::StepHealth::kDiverged) {
    ++divergences_;
    events_.Add(EventKind::kDivergence);
    if (settings_.reset_on_divergence) {
      physics_.Reset();
      for (std::size_t i = 0; i < robots_.size(); ++i) {
        Reset(i, robots_[i].start_pose());
        robots_[i].NoteChanges(t);
      }
    }
  } else {
    for (Robot& robot : robots_) robot.Tell(step_);
  }
  ++step_;
  events_.SetStep(step_, time());
  if (pace_.steps_left > 0) --pace_.steps_left;
  return health;
}

void World::Attend(time::Clock::Time now, bool calls) {
  now_ = now;
  TakeRequests();
  for (Robot& robot : robots_) {
    if (calls) robot.ServeCalls(time(), now);
    if (pace_.stands_still()) robot.KeepNewest();
  }
}

void World::Reset(std::size_t robot, robot::StartPose pose) {
  forces_[robot].pushes.Clear();
  forces_[robot].drags.Clear();
  if (robots_.size() == 1) physics_.Reset();  // also resets movable objects of the scene
  robots_[robot].Reset(pose);
}

Status World::status(std::size_t robot, const LoopReading& loop) const {
  Status status;
  status.loop = loop;
  status.time = time();
  status.steps = step_;
  status.speed = pace_.speed;
  status.paused = pace_.paused;
  status.steps_left = pace_.steps_left;
  status.divergences = divergences_;
  status.script_done = script_done_;
  status.script_refused = script_refused_;
  for (const ScriptTurn& turn : script_turns_) {
    const ScriptEvent& event = script_[turn.event];
    if (!event.when || turn.since > time()) continue;
    if (status.script_waiting++ > 0) continue;
    CopyText(event.where, &status.script_where);
    CopyText(event.condition, &status.script_waits_for);
  }
  robots_[robot].Report(time(), &status);
  return status;
}

}  // namespace understudy::emulator
