#include "emulator/request_acts.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/nearest_word.h"
#include "emulator/live_settings.h"
#include "emulator/world.h"
#include "physics/world_reading.h"
#include "robot/fault.h"
#include "robot/start_pose.h"

namespace understudy::emulator {
namespace {

Error NoBody(const physics::MujocoWorld& world, std::string_view name) {
  std::vector<std::string> names = physics::BodyNames(world);
  names.erase(names.begin());  // the world, which does not move
  return {"the model has no body '" + std::string(name) + "'" + DidYouMean(name, names)};
}

// By its name in the world's model, or by the one that it has in the robot's own.
Result<int> FindBody(const physics::MujocoWorld& world, std::size_t robot, std::string_view name) {
  int body = world.FindBody(std::string(name));
  if (body < 0) body = world.robot(robot).FindBody(std::string(name));
  if (body < 0) return NoBody(world, name);
  if (body == 0) return Error{"'" + std::string(name) + "' does not move"};
  if (const physics::LooseBody* const found = world.ObjectOf(body); found && found->walks) {
    return Error{"'" + found->name + "' walks along its path; no force moves it"};
  }
  return body;
}

Result<const physics::LooseBody*> FindObject(const physics::MujocoWorld& world,
                                             std::string_view name) {
  if (const physics::LooseBody* const found = world.FindObject(name)) {
    if (!found->walks) return found;
    return Error{"'" + found->name + "' walks along its path; reset puts it back at the start"};
  }
  std::vector<std::string> names;
  for (const physics::LooseBody& object : world.objects()) {
    if (!object.walks) names.push_back(object.name);
  }
  if (names.empty()) return Error{"the scene has no objects"};
  return Error{"the scene has no object '" + std::string(name) + "'" + DidYouMean(name, names)};
}

std::uint16_t KeysOf(const Request& request) {
  return static_cast<std::uint16_t>(request.number("keys"));
}

Answer PayOut(Robot& robot, double metres) {
  if (!robot.crane().attached()) return Error{"the robot does not hang from the crane"};
  robot.crane().Lower(metres);
  return {};
}

}  // namespace

Result<int> RequestActs::BodyOf(const World& world, const Robot& robot, Request* request) {
  if (!request->has("body")) request->SetName("body", robot.spec().base_body);
  auto body = FindBody(world.physics_, request->robot, request->name());
  for (std::size_t i = 0; body && i < world.robots_.size(); ++i) {
    if (world.physics_.robot(i).Has(*body)) request->robot = i;
  }
  return body;
}

double RequestActs::Until(const World& world, const Request& request, double t) {
  return t + std::max(request.number("for"), world.physics_.timestep());
}

Answer RequestActs::Pause(World& world, Robot&, Request&, double) {
  world.pace_.paused = true;
  world.pace_.steps_left = 0;
  return {};
}

Answer RequestActs::Resume(World& world, Robot&, Request&, double) {
  world.pace_.paused = false;
  world.pace_.steps_left = 0;
  return {};
}

Answer RequestActs::Step(World& world, Robot&, Request& request, double) {
  if (!world.pace_.paused) return Error{"the robot is not paused"};
  if (world.steppers_.size() == world.steppers_.capacity()) {
    return Error{"too many requests are waiting for their steps"};
  }
  world.pace_.steps_left += static_cast<std::int64_t>(request.number("steps"));
  return {};
}

Answer RequestActs::SetSpeed(World& world, Robot&, Request& request, double) {
  world.pace_.speed = request.number("speed");
  return {};
}

Answer RequestActs::Reset(World& world, Robot& robot, Request& request, double t) {
  const bool all = request.on("all");
  const auto is_meant = [&](const Robot& one) { return all || &one == &robot; };
  const auto pose_of = [named = request.has("pose"),
                        pose = request.number("pose")](const Robot& one) {
    return named ? static_cast<robot::StartPose>(pose) : one.start_pose();
  };
  for (const Robot& one : world.robots_) {
    if (is_meant(one) && pose_of(one) == robot::StartPose::kStanding &&
        one.owner().active().empty() && one.spec().kind == robot::RobotKind::kHumanoid) {
      return Error{
          "a standing humanoid falls while no motion service balances it; reset it hanging "
          "or clamped"};
    }
  }
  if (all) world.physics_.Reset();
  for (std::size_t i = 0; i < world.robots_.size(); ++i) {
    Robot& one = world.robots_[i];
    if (!is_meant(one)) continue;
    world.Reset(i, pose_of(one));
    one.NoteChanges(t);
  }
  if (!all) request.SetNumber("pose", static_cast<double>(pose_of(robot)));
  return {};
}

Answer RequestActs::Push(World& world, Robot& robot, Request& request, double t) {
  const auto body = BodyOf(world, robot, &request);
  if (!body) return body.error();
  const Eigen::Vector3d force = request.has("force")
                                    ? request.vector("force")
                                    : request.vector("impulse") / request.number("for");
  if (!world.forces_[request.robot].pushes.Begin(*body, force, Until(world, request, t))) {
    return Error{"too many pushes are under way"};
  }
  return {};
}

Answer RequestActs::Drag(World& world, Robot& robot, Request& request, double t) {
  const auto body = BodyOf(world, robot, &request);
  if (!body) return body.error();
  if (!world.forces_[request.robot].drags.Pull(*body, request.vector("at"), request.vector("to"),
                                               Until(world, request, t))) {
    return Error{"too many bodies are being dragged"};
  }
  return {};
}

Answer RequestActs::LetGo(World& world, Robot& robot, Request& request, double) {
  if (!request.has("body")) {
    world.forces_[request.robot].drags.Clear();
    return {};
  }
  const auto body = BodyOf(world, robot, &request);
  if (!body) return body.error();
  world.forces_[request.robot].drags.Release(*body);
  return {};
}

Answer RequestActs::PlaceObject(World& world, Robot&, Request& request, double) {
  const auto object = FindObject(world.physics_, request.name());
  if (!object) return object.error();
  world.physics_.PlaceObject(**object, request.vector("pos"), request.number("yaw"));
  return {};
}

Answer RequestActs::LowerCrane(World&, Robot& robot, Request& request, double) {
  return PayOut(robot, request.number("by"));
}

Answer RequestActs::RaiseCrane(World&, Robot& robot, Request& request, double) {
  return PayOut(robot, -request.number("by"));
}

Answer RequestActs::AttachCrane(World&, Robot& robot, Request&, double) {
  robot.AttachCrane();
  return {};
}

Answer RequestActs::ReleaseCrane(World&, Robot& robot, Request&, double) {
  robot.crane().Release();
  return {};
}

Answer RequestActs::Clamp(World&, Robot& robot, Request& request, double) {
  robot.Clamp(request.on("on"));
  return {};
}

Answer RequestActs::SwitchPower(World&, Robot& robot, Request& request, double t) {
  return robot.SwitchPower(request.on("on"), t);
}

Answer RequestActs::SetFault(World&, Robot& robot, Request& request, double t) {
  const std::string_view kind =
      robot::FaultNames()[static_cast<std::size_t>(request.number("fault"))];
  const double by = request.number("by");
  return robot.SetFault(request.name(), kind, request.has("by") ? &by : nullptr,
                        {.lasts = request.number("for"),
                         .ramp = request.number("ramp"),
                         .probability = request.number("probability")},
                        t);
}

Answer RequestActs::Set(World& world, Robot& robot, Request& request, double) {
  return world.Set(&robot, request);
}

Answer RequestActs::MoveJoint(World&, Robot& robot, Request& request, double t) {
  return robot.MoveJoint(request.name(), request.number("angle"), t + request.number("for"));
}

Answer RequestActs::PressKeys(World&, Robot& robot, Request& request, double t) {
  robot.remote().Press(KeysOf(request), t + request.number("for"));
  return {};
}

Answer RequestActs::HoldKeys(World&, Robot& robot, Request& request, double) {
  robot.remote().Hold(KeysOf(request));
  return {};
}

Answer RequestActs::ReleaseKeys(World&, Robot& robot, Request& request, double) {
  robot.remote().Release(KeysOf(request));
  return {};
}

Answer RequestActs::MoveSticks(World&, Robot& robot, Request& request, double t) {
  constexpr std::string_view kSticks[] = {"lx", "ly", "rx", "ry"};
  const double seconds = request.number("for");
  const double until = seconds > 0 ? t + seconds : robot::kForever;
  for (std::size_t i = 0; i < std::size(kSticks); ++i) {
    if (request.has(kSticks[i])) robot.remote().Move(i, request.number(kSticks[i]), until);
  }
  return {};
}

Answer RequestActs::SetRemote(World&, Robot& robot, Request& request, double t) {
  const robot::RemoteReading held{.keys = KeysOf(request),
                                  .lx = request.number("lx"),
                                  .ly = request.number("ly"),
                                  .rx = request.number("rx"),
                                  .ry = request.number("ry")};
  const double until = t + request.number("for");
  if (request.has("press")) {
    robot.remote().Renew(held, static_cast<std::int64_t>(request.number("press")), t, until);
  } else {
    robot.remote().Set(held, until);
  }
  return {};
}

Answer RequestActs::SwitchRemoteOn(World&, Robot& robot, Request&, double) {
  robot.remote().Switch(true);
  return {};
}

Answer RequestActs::SwitchRemoteOff(World&, Robot& robot, Request&, double) {
  robot.remote().Switch(false);
  return {};
}

Answer RequestActs::StartRecording(World& world, Robot&, Request& request, double) {
  return world.recordings_[request.robot].Start(request.file(), request.on("overwrite"));
}

Answer RequestActs::StopRecording(World& world, Robot&, Request& request, double) {
  return world.recordings_[request.robot].Stop();
}

Answer RequestActs::CallService(World& world, Robot& robot, Request& request, double) {
  const auto api = static_cast<std::int64_t>(request.number("api"));
  const auto code = robot.Call(request.name(), api, request.json(), world.now_);
  if (!code) return Error{"nothing serves '" + std::string(request.name()) + "'"};
  if (*code != 0) return Error{"the service answers " + std::to_string(*code)};
  return {};
}

Answer World::CheckNames(const Request& request) const {
  if (request.robot >= robots_.size()) {
    return Error{"robot: the world has no robot " + std::to_string(request.robot)};
  }
  if (request.row->carry_out == RequestActs::Set) {
    const auto value = SettingOf(request);
    return value ? Answer{} : Answer{value.error()};
  }
  if (request.row->carry_out == RequestActs::PlaceObject) {
    const auto object = FindObject(physics_, request.name());
    return object ? Answer{} : Answer{Error{"object: " + object.why()}};
  }
  const bool named = std::ranges::any_of(
      request.row->fields, [](const Field& field) { return field.type == &types::kBody; });
  if (!named || request.name().empty()) return {};
  const auto body = FindBody(physics_, request.robot, request.name());
  return body ? Answer{} : Answer{Error{"body: " + body.why()}};
}

}  // namespace understudy::emulator
