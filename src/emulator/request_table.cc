// The table of requests.
#include "emulator/request.h"
#include "emulator/request_acts.h"
#include "robot/fault.h"
#include "robot/start_pose.h"

namespace understudy::emulator {
namespace {

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
      Row("pause", "Pause simulated time: nothing is sent, requests and services are answered", {},
          Acts::Pause, "pause"),
      Row("resume", "Resume simulated time", {}, Acts::Resume, "resume", false, kPeople),
      Row("step", "Make steps while the robot is paused, at the speed that is set",
          {Or(1, Bare(Ranged("steps", kWhole, "", 1, kMostSteps,
                             "How many; a step is 1 ms unless configured"))),
           Or(1, {.key = "wait",
                  .type = &kSwitch,
                  .does = "Whether to answer only when they are made"})},
          Acts::Step, "step 1000", kNoted),
      Row("speed", "Set how fast simulated time goes, and nothing else",
          {Needed(Bare({.key = "speed",
                        .type = &types::kSpeed,
                        .unit = "s/s",
                        .does = "Simulated seconds per second of wall time"}))},
          Acts::SetSpeed, "speed 0.1"),
      Row("reset",
          "Put the robot back into a start pose, at rest; time and script go on, and services "
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
      Row("push", "Push a body at its centre of mass with a force, for a time",
          {Bare({.key = "body",
                 .type = &types::kBody,
                 .does = "Of the model; the base unless one is named"}),
           Bare(Ranged("force", kVector, "N", -kHardest, kHardest, "Along the axes of the world")),
           Ranged("impulse", kVector, "N·s", -kHardest, kHardest,
                  "In place of a force; spread evenly over the time"),
           Or(0.1, seconds(kLeastTime, kLongest, "Simulated time that it acts"))},
          Acts::Push, "push base_link 100 0 0 --for 0.2", kNoted, kBoth, OneOfForceAndImpulse),
      Row("drag",
          "Pull a point of a body to a place by a spring, as a mouse does; the spring suits the "
          "mass that hangs on the body. A repeated request prolongs it",
          {Needed(Bare({.key = "body", .type = &types::kBody, .does = "Of the model"})),
           Needed(Bare(Ranged("to", kVector, "m", -kInWorld, kInWorld, "In the world"))),
           Or(0, Ranged("at", kVector, "m", -kOnBody, kOnBody,
                        "The point that is dragged, in the body's frame")),
           Or(0.5, seconds(kLeastTime, kLongestDrag, "Simulated time that it lasts"))},
          Acts::Drag, "drag base_link 0 0 0.6 --for 5", kNoted),
      Row("let_go", "End a drag",
          {Bare({.key = "body",
                 .type = &types::kBody,
                 .does = "The body that is let go; all of the robot's unless one is named"})},
          Acts::LetGo, "let_go base_link", kNoted),
      Row("object", "Put an object of the scene somewhere, upright and at rest",
          {Needed(Bare({.key = "object", .type = &types::kName, .does = "Its name"})),
           Needed(Bare(Ranged("pos", kVector, "m", -kInWorld, kInWorld,
                              "Where the middle of its underside is to be in the world"))),
           Or(0, Ranged("yaw", kNumber, "rad", -kMostAngle, kMostAngle,
                        "Its turn about the world's z axis"))},
          Acts::PlaceObject, "object cube 0.4 0 0.75", kNoted),
      Row("crane.lower", "Lower the robot, at crane.speed", {metres}, Acts::LowerCrane,
          "crane lower 0.2", kNoted),
      Row("crane.raise", "Raise the robot, at crane.speed", {metres}, Acts::RaiseCrane,
          "crane raise 0.2", kNoted),
      Row("crane.attach", "Hang the robot from the crane, whose hook is then straight above it", {},
          Acts::AttachCrane, "crane attach"),
      Row("crane.release", "Release the robot from the crane, so that it drops", {},
          Acts::ReleaseCrane, "crane release"),
      Row("clamp", "Hold the base where it is, or let it go",
          {Needed(Bare({.key = "on", .type = &kSwitch, .does = "Whether it is held"}))},
          Acts::Clamp, "clamp on"),
      Row("joint",
          "Pose a joint of a clamped robot that no program commands, as if by hand: at 1 rad/s at "
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
          "Switch the robot's power. Off, its motors have no torque and nothing is sent, "
          "received or answered; on, it boots as on hardware, in the times of robot.boot",
          {Needed(Bare({.key = "on", .type = &kSwitch, .does = "Whether it is switched on"}))},
          Acts::SwitchPower, "power on"),
      Row("fault",
          "Inject a fault into a component; it survives a reset: "
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
          Row("set", "Change a setting of the running robot, from the next step on",
              {Needed(Bare({.key = "key",
                            .type = &types::kSetting,
                            .does = "Key of the configuration, as in --set; `ctl set` without one "
                                    "lists all"})),
               Needed(
                   Bare({.key = "value",
                         .type = &types::kValue,
                         .does = "As in --set: docs/reference/config.md has its unit and range"}))},
              Acts::Set, "set sensors.noise_gain 3")),
      Row("remote.press", "Press keys together and release them again",
          {keys, Or(0.1, seconds(kLeastTime, kLongest, "Simulated time that they stay down"))},
          Acts::PressKeys, "remote press L2+B"),
      Row("remote.hold", "Press keys and keep them down", {keys}, Acts::HoldKeys, "remote hold L2"),
      Row("remote.release", "Release keys", {keys}, Acts::ReleaseKeys, "remote release L2"),
      Row("remote.sticks", "Move sticks; those that are not named stay where they are",
          {lx, ly, rx, ry,
           Or(0, seconds(0, kLongest,
                         "Simulated time after which they return to the middle; 0 is never"))},
          Acts::MoveSticks, "remote sticks --ly 0.5 --for 2", false, kBoth, AnyStick),
      Row("remote.set",
          "Set all keys and sticks of the remote controller at once: keys that are not named are "
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
      Row("remote.on", "Switch the remote controller on; using it does so, too", {},
          Acts::SwitchRemoteOn, "remote on"),
      Row("remote.off",
          "Switch the remote controller off: keys and sticks are released and the robot receives "
          "nothing",
          {}, Acts::SwitchRemoteOff, "remote off"),
      Row("record.start",
          "Start a recording of all topics, the simulation's truth and the events: "
          "docs/recording.md",
          {Bare({.key = "file",
                 .type = &types::kFile,
                 .does =
                     "File to write; unless given, one in the folder where the robot was started, "
                     "named by robot and time"}),
           Or(0, {.key = "overwrite", .type = &kSwitch, .does = "Replace a file of that name"})},
          Acts::StartRecording, "record start walk.mcap --overwrite", kNoted),
      Row("record.stop", "End the recording; its file is then complete", {}, Acts::StopRecording,
          "record stop", kNoted),
      Row("service.call",
          "Call a service of the robot, as a program does over DDS; any answer but 0 is an error",
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
