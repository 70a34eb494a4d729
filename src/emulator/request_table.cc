// The table of requests and their implementations.
#include <algorithm>
#include <utility>

#include "base/nearest_word.h"
#include "emulator/live_settings.h"
#include "emulator/request.h"
#include "emulator/world.h"
#include "physics/world_reading.h"
#include "robot/fault.h"
#include "robot/start_pose.h"

namespace understudy::emulator {
namespace {

Error NoBody(const physics::World& world, std::string_view name) {
  return {"the model has no body '" + std::string(name) + "'" +
          NearestHint(name, physics::BodyNames(world))};
}

// By its name in the world's model, or by the one that it has in the robot's own.
Result<int> FindBody(const physics::World& world, std::size_t robot, std::string_view name) {
  int body = world.FindBody(std::string(name));
  if (body < 0) body = world.robot(robot).FindBody(std::string(name));
  if (body < 0) return NoBody(world, name);
  if (body == 0) return Error{"'" + std::string(name) + "' does not move"};
  return body;
}

std::uint16_t KeysOf(const Request& request) {
  return static_cast<std::uint16_t>(request.number("keys"));
}

std::string_view OneOfForceAndImpulse(const Request& push) {
  return push.has("force") != push.has("impulse") ? "" : "expected either force or impulse";
}

std::string_view AnyStick(const Request& sticks) {
  const bool any = sticks.has("lx") || sticks.has("ly") || sticks.has("rx") || sticks.has("ry");
  return any ? "" : "expected at least one of lx, ly, rx, ry";
}

RequestRow Row(std::string_view name, std::string_view does, std::vector<Field> fields,
               Answer (*carry_out)(World& world, Robot& robot, Request& request, double t),
               std::string_view example, bool noted = false, From from = From::kBoth,
               std::string_view (*check)(const Request& request) = nullptr) {
  return {name, does, std::move(fields), carry_out, example, noted, from, check};
}

RequestRow Lists(std::string_view path, RequestRow row) {
  row.list = path;
  return row;
}

Field Ranged(std::string_view key, const schema::Type& type, std::string_view unit, double least,
             double most, std::string_view does) {
  return {key, &type, unit, {least, most}, does};
}

Field Needed(Field field) {
  field.required = true;
  return field;
}

Field Bare(Field field) {
  field.bare = true;
  return field;
}

Field Or(double otherwise, Field field) {
  field.otherwise = otherwise;
  return field;
}

}  // namespace

struct RequestActs {
  // Returns the id of the named body, which must be movable; by default the base, whose name is
  // then filled in. The request is then one to the robot that has the body, if any has it.
  static Result<int> BodyOf(const World& world, const Robot& robot, Request* request) {
    if (!request->has("body")) request->SetName("body", robot.spec().base_body);
    auto body = FindBody(world.physics_, request->robot, request->name());
    for (std::size_t i = 0; body && i < world.robots_.size(); ++i) {
      if (world.physics_.robot(i).Has(*body)) request->robot = i;
    }
    return body;
  }

  // Even the shortest push acts in one step.
  static double Until(const World& world, const Request& request, double t) {
    return t + std::max(request.number("for"), world.physics_.timestep());
  }

  static Answer Pause(World& world, Robot&, Request&, double) {
    world.pace_.paused = true;
    world.pace_.steps_left = 0;
    return {};
  }

  static Answer Resume(World& world, Robot&, Request&, double) {
    world.pace_.paused = false;
    world.pace_.steps_left = 0;
    return {};
  }

  static Answer Step(World& world, Robot&, Request& request, double) {
    if (!world.pace_.paused) return Error{"the robot is not paused"};
    if (world.steppers_.size() == world.steppers_.capacity()) {
      return Error{"too many requests are waiting for their steps"};
    }
    world.pace_.steps_left += static_cast<std::int64_t>(request.number("steps"));
    return {};
  }

  static Answer SetSpeed(World& world, Robot&, Request& request, double) {
    world.pace_.speed = request.number("speed");
    return {};
  }

  static Answer Reset(World& world, Robot& robot, Request& request, double t) {
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

  static Answer Push(World& world, Robot& robot, Request& request, double t) {
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

  static Answer Drag(World& world, Robot& robot, Request& request, double t) {
    const auto body = BodyOf(world, robot, &request);
    if (!body) return body.error();
    if (!world.forces_[request.robot].drags.Pull(*body, request.vector("at"), request.vector("to"),
                                                 Until(world, request, t))) {
      return Error{"too many bodies are being dragged"};
    }
    return {};
  }

  static Answer LetGo(World& world, Robot& robot, Request& request, double) {
    if (!request.has("body")) {
      world.forces_[request.robot].drags.Clear();
      return {};
    }
    const auto body = BodyOf(world, robot, &request);
    if (!body) return body.error();
    world.forces_[request.robot].drags.Release(*body);
    return {};
  }

  static Answer PayOut(Robot& robot, double metres) {
    if (!robot.crane().attached()) return Error{"the robot does not hang from the crane"};
    robot.crane().Lower(metres);
    return {};
  }
  static Answer LowerCrane(World&, Robot& robot, Request& request, double) {
    return PayOut(robot, request.number("by"));
  }
  static Answer RaiseCrane(World&, Robot& robot, Request& request, double) {
    return PayOut(robot, -request.number("by"));
  }
  static Answer AttachCrane(World&, Robot& robot, Request&, double) {
    robot.AttachCrane();
    return {};
  }
  static Answer ReleaseCrane(World&, Robot& robot, Request&, double) {
    robot.crane().Release();
    return {};
  }

  static Answer Clamp(World&, Robot& robot, Request& request, double) {
    robot.Clamp(request.on("on"));
    return {};
  }

  static Answer SwitchPower(World&, Robot& robot, Request& request, double t) {
    return robot.SwitchPower(request.on("on"), t);
  }

  static Answer SetFault(World&, Robot& robot, Request& request, double t) {
    const std::string_view kind =
        robot::FaultNames()[static_cast<std::size_t>(request.number("fault"))];
    const double by = request.number("by");
    return robot.SetFault(request.name(), kind, request.has("by") ? &by : nullptr,
                          {.lasts = request.number("for"),
                           .ramp = request.number("ramp"),
                           .probability = request.number("probability")},
                          t);
  }

  static Answer Set(World& world, Robot& robot, Request& request, double) {
    return world.Set(&robot, request);
  }

  static Answer MoveJoint(World&, Robot& robot, Request& request, double t) {
    return robot.MoveJoint(request.name(), request.number("angle"), t + request.number("for"));
  }

  static Answer PressKeys(World&, Robot& robot, Request& request, double t) {
    robot.remote().Press(KeysOf(request), t + request.number("for"));
    return {};
  }
  static Answer HoldKeys(World&, Robot& robot, Request& request, double) {
    robot.remote().Hold(KeysOf(request));
    return {};
  }
  static Answer ReleaseKeys(World&, Robot& robot, Request& request, double) {
    robot.remote().Release(KeysOf(request));
    return {};
  }
  static Answer MoveSticks(World&, Robot& robot, Request& request, double t) {
    constexpr std::string_view kSticks[] = {"lx", "ly", "rx", "ry"};
    const double seconds = request.number("for");
    const double until = seconds > 0 ? t + seconds : robot::kForever;
    for (std::size_t i = 0; i < std::size(kSticks); ++i) {
      if (request.has(kSticks[i])) robot.remote().Move(i, request.number(kSticks[i]), until);
    }
    return {};
  }
  static Answer SetRemote(World&, Robot& robot, Request& request, double t) {
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
  static Answer SwitchRemoteOn(World&, Robot& robot, Request&, double) {
    robot.remote().Switch(true);
    return {};
  }
  static Answer SwitchRemoteOff(World&, Robot& robot, Request&, double) {
    robot.remote().Switch(false);
    return {};
  }

  static Answer StartRecording(World& world, Robot&, Request& request, double) {
    return world.recordings_[request.robot].Start(request.file(), request.on("overwrite"));
  }
  static Answer StopRecording(World& world, Robot&, Request& request, double) {
    return world.recordings_[request.robot].Stop();
  }

  static Answer CallService(World& world, Robot& robot, Request& request, double) {
    const auto api = static_cast<std::int64_t>(request.number("api"));
    const auto code = robot.Call(request.name(), api, request.json(), world.now_);
    if (!code) return Error{"nothing serves '" + std::string(request.name()) + "'"};
    if (*code != 0) return Error{"the service answers " + std::to_string(*code)};
    return {};
  }
};

Answer World::CheckNames(const Request& request) const {
  if (request.robot >= robots_.size()) {
    return Error{"robot: the world has no robot " + std::to_string(request.robot)};
  }
  if (request.row->carry_out == RequestActs::Set) {
    const auto value = SettingOf(request);
    return value ? Answer{} : Answer{value.error()};
  }
  const bool named = std::ranges::any_of(
      request.row->fields, [](const Field& field) { return field.type == &types::kBody; });
  if (!named || request.name().empty()) return {};
  const auto body = FindBody(physics_, request.robot, request.name());
  return body ? Answer{} : Answer{Error{"body: " + body.why()}};
}

const std::vector<RequestRow>& RequestRows() {
  using schema::kNumber, schema::kSwitch, schema::kVector, schema::kWhole, schema::kWord;
  using enum From;
  using Acts = RequestActs;
  constexpr bool kNoted = true;

  // All bounds are *assumed*: far beyond useful values and within what the physics can simulate.
  // The default durations of a press, a push and a drag are *assumed* too.
  constexpr double kLeastTime = 1e-4, kLongest = 1e6, kLongestDrag = 60;  // s
  constexpr double kHardest = 1e6;                                        // N or N·s
  constexpr double kOnBody = 10, kInWorld = 1e6, kMostCrane = 10;         // m
  constexpr double kMostSteps = 1e6;
  constexpr double kMostAngle = 10;  // rad, as of start poses
  constexpr double kMostApi = 1e6;
  constexpr double kMostPresses = 1e8;
  constexpr double kMostFault = 1e3;  // in any unit; each kind has limits of its own

  const Field keys = Needed(Bare({.key = "keys", .type = &types::kKeys, .does = "Joined by +"}));
  const Field metres = Needed(
      Bare(Ranged("by", kNumber, "m", -kMostCrane, kMostCrane, "Less than 0 is the other way")));
  const Field lx = Ranged("lx", kNumber, "", -1, 1, "Right"),
              ly = Ranged("ly", kNumber, "", -1, 1, "Forward");
  const Field rx = Ranged("rx", kNumber, "", -1, 1, "Right"),
              ry = Ranged("ry", kNumber, "", -1, 1, "Forward");
  const auto seconds = [](double least, double most, std::string_view does) {
    return Ranged("for", kNumber, "s", least, most, does);
  };

  static const std::vector<RequestRow> kRows = {
      Row("pause",
          "Simulated time stands still: nothing is sent, requests and services are answered", {},
          Acts::Pause, "pause"),
      Row("resume", "Simulated time goes on", {}, Acts::Resume, "resume", false, kPeople),
      Row("step", "Makes steps while the robot is paused, at the speed that is set",
          {Or(1, Bare(Ranged("steps", kWhole, "", 1, kMostSteps,
                             "How many; a step is 1 ms unless configured"))),
           Or(1, {.key = "wait",
                  .type = &kSwitch,
                  .does = "Whether to answer only when they are made"})},
          Acts::Step, "step 1000", kNoted),
      Row("speed", "Sets how fast simulated time goes; changes nothing else",
          {Needed(Bare({.key = "speed",
                        .type = &types::kSpeed,
                        .unit = "s/s",
                        .does = "Simulated seconds per second of wall time"}))},
          Acts::SetSpeed, "speed 0.1"),
      Row("reset",
          "Puts the robot back into a start pose, at rest; time and script go on, and services "
          "stay on or off. Other robots and, beside them, the objects of the scene stay where they "
          "are",
          {Bare({.key = "pose",
                 .type = &kWord,
                 .does = "The start pose unless one is named",
                 .words = robot::kStartPoses}),
           Or(0, {.key = "all",
                  .type = &kSwitch,
                  .does = "All robots of the world, each to its own pose unless one is named, and "
                          "the objects of the scene to their places"})},
          Acts::Reset, "reset hanging", kNoted),
      Row("push", "Pushes a body at its centre of mass with a force, for a time",
          {Bare({.key = "body",
                 .type = &types::kBody,
                 .does = "Of the model; the base unless one is named"}),
           Bare(Ranged("force", kVector, "N", -kHardest, kHardest, "Along the axes of the world")),
           Ranged("impulse", kVector, "N·s", -kHardest, kHardest,
                  "In place of a force; spread evenly over the time"),
           Or(0.1, seconds(kLeastTime, kLongest, "Simulated time that it acts"))},
          Acts::Push, "push base_link 100 0 0 --for 0.2", kNoted, kBoth, OneOfForceAndImpulse),
      Row("drag",
          "Pulls a point of a body to a place by a spring, as a mouse does; the spring suits the "
          "mass that hangs on the body. A repeated request prolongs it",
          {Needed(Bare({.key = "body", .type = &types::kBody, .does = "Of the model"})),
           Needed(Bare(Ranged("to", kVector, "m", -kInWorld, kInWorld, "In the world"))),
           Or(0, Ranged("at", kVector, "m", -kOnBody, kOnBody,
                        "The point that is dragged, in the body's frame")),
           Or(0.5, seconds(kLeastTime, kLongestDrag, "Simulated time that it lasts"))},
          Acts::Drag, "drag base_link 0 0 0.6 --for 5", kNoted),
      Row("let_go", "Ends a drag",
          {Bare({.key = "body",
                 .type = &types::kBody,
                 .does = "The body that is let go; all of the robot's unless one is named"})},
          Acts::LetGo, "let_go base_link", kNoted),
      Row("crane.lower", "Lowers the robot, at crane.speed", {metres}, Acts::LowerCrane,
          "crane lower 0.2", kNoted),
      Row("crane.raise", "Raises the robot, at crane.speed", {metres}, Acts::RaiseCrane,
          "crane raise 0.2", kNoted),
      Row("crane.attach", "Hangs the robot from the crane, whose hook is then straight above it",
          {}, Acts::AttachCrane, "crane attach"),
      Row("crane.release", "Releases the robot from the crane, so that it drops", {},
          Acts::ReleaseCrane, "crane release"),
      Row("clamp", "Holds the base where it is, or lets it go",
          {Needed(Bare({.key = "on", .type = &kSwitch, .does = "Whether it is held"}))},
          Acts::Clamp, "clamp on"),
      Row("joint",
          "Poses a joint of a clamped robot that no program commands, as if by hand: at 1 rad/s at "
          "most, with the gains that hold a start pose. A repeated request prolongs it",
          {Needed(Bare({.key = "joint",
                        .type = &types::kName,
                        .does = "A joint with a motor; not one of a hand"})),
           Needed(Bare(Ranged("angle", kNumber, "rad", -kMostAngle, kMostAngle,
                              "Within the range of the joint"))),
           Or(2,
              seconds(
                  kLeastTime, kLongestDrag,
                  "Simulated time for which it is held; then the previous commands apply again"))},
          Acts::MoveJoint, "joint FR_calf_joint -1.5 --for 5", kNoted),
      Row("power",
          "Switches the robot's power. Off, its motors have no torque and nothing is sent, "
          "received or answered; on, it boots as on hardware, in the times of robot.boot",
          {Needed(Bare({.key = "on", .type = &kSwitch, .does = "Whether it is switched on"}))},
          Acts::SwitchPower, "power on"),
      Row("fault",
          "Injects a fault into a component; it survives a reset: "
          "docs/reference/faults.md",
          {Needed(Bare({.key = "component",
                        .type = &types::kName,
                        .does = "JOINT (its motor), JOINT.encoder, imu, foot.FR, battery, remote, "
                                "a topic, service.sport, ...; with the fault none also all"})),
           Needed(Bare({.key = "fault",
                        .type = &kWord,
                        .does = "What is wrong with it; none removes all of its faults",
                        .words = robot::FaultNames()})),
           Ranged("by", kNumber, "", -kMostFault, kMostFault,
                  "How much, in the unit of the fault; a usual amount unless given"),
           Or(0, seconds(0, kLongest, "Simulated time that it lasts; 0 is until it is removed")),
           Or(0, Ranged("ramp", kNumber, "s", 0, kLongest,
                        "Simulated time in which it grows from nothing to its full amount")),
           Or(1,
              Ranged("probability", kNumber, "", 0, 1,
                     "Probability that it is there, drawn anew every tenth of a second: for loose "
                     "contacts"))},
          Acts::SetFault, "fault FR_calf_joint.encoder offset --by 0.1 --ramp 5"),
      Lists(
          "/settings",
          Row("set", "Changes a setting of the running robot, from the next step on",
              {Needed(Bare({.key = "key",
                            .type = &types::kSetting,
                            .does = "Key of the configuration, as in --set; `ctl set` without one "
                                    "lists all"})),
               Needed(
                   Bare({.key = "value",
                         .type = &types::kValue,
                         .does = "As in --set: docs/reference/config.md has its unit and range"}))},
              Acts::Set, "set sensors.noise_gain 3")),
      Row("remote.press", "Presses keys together and releases them again",
          {keys, Or(0.1, seconds(kLeastTime, kLongest, "Simulated time that they stay down"))},
          Acts::PressKeys, "remote press L2+B"),
      Row("remote.hold", "Presses keys and keeps them down", {keys}, Acts::HoldKeys,
          "remote hold L2"),
      Row("remote.release", "Releases keys", {keys}, Acts::ReleaseKeys, "remote release L2"),
      Row("remote.sticks", "Moves sticks; those that are not named stay where they are",
          {lx, ly, rx, ry,
           Or(0, seconds(0, kLongest,
                         "Simulated time after which they return to the middle; 0 is never"))},
          Acts::MoveSticks, "remote sticks --ly 0.5 --for 2", false, kBoth, AnyStick),
      Row("remote.set",
          "Sets all keys and sticks of the remote controller at once: keys that are not named are "
          "released. Everything is released after the time unless this is asked again, so that a "
          "program that has died or hangs leaves nothing pressed",
          {{.key = "keys", .type = &types::kMaybeKeys, .does = "Joined by +; no key unless given"},
           lx,
           ly,
           rx,
           ry,
           Needed(
               seconds(kLeastTime, kLongest, "Simulated time after which everything is released")),
           Ranged(
               "press", kWhole, "", 0, kMostPresses,
               "Number of the press: keys that were released because the time was over stay "
               "released "
               "until the number changes, so that a request that comes late is no second press")},
          Acts::SetRemote, "remote set --keys A --for 1"),
      Row("remote.on", "Switches the remote controller on; using it does so, too", {},
          Acts::SwitchRemoteOn, "remote on"),
      Row("remote.off",
          "Switches the remote controller off: keys and sticks are released and the robot receives "
          "nothing",
          {}, Acts::SwitchRemoteOff, "remote off"),
      Row("record.start",
          "Starts a recording of all topics, the simulation's truth and the events: "
          "docs/recording.md",
          {Bare({.key = "file",
                 .type = &types::kFile,
                 .does =
                     "File to write; unless given, one in the folder where the robot was started, "
                     "named by robot and time"}),
           Or(0, {.key = "overwrite", .type = &kSwitch, .does = "Replace a file of that name"})},
          Acts::StartRecording, "record start walk.mcap --overwrite", kNoted),
      Row("record.stop", "Ends the recording; its file is then complete", {}, Acts::StopRecording,
          "record stop", kNoted),
      Row("service.call",
          "Calls a service of the robot, as a program does over DDS; any answer but 0 is an error",
          {Needed(Bare({.key = "service",
                        .type = &types::kName,
                        .does = "Name of the service, as in rt/api/<service>/request"})),
           Needed(Bare(Ranged("api", kWhole, "", 0, kMostApi, "Id of the api"))),
           Bare({.key = "parameter",
                 .type = &types::kJson,
                 .does = "Its parameter; none unless given"})},
          Acts::CallService, "service call motion_switcher 1003"),
  };
  return kRows;
}

}  // namespace understudy::emulator
