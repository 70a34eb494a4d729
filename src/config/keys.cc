#include "config/keys.h"

#include <algorithm>
#include <iterator>

#include "config/randomization_keys.h"
#include "emulator/request.h"
#include "robot/fault.h"
#include "robot/start_pose.h"

namespace understudy::config {
namespace {

void DescribeNetwork(Archive& a, NetworkConfig& c) {
  a.Key(UNDERSTUDY_NVP(c.interface), {"Network interface for DDS; lo stays on this machine"});
  a.Key(UNDERSTUDY_NVP(c.domain),
        {"", {0, 232}, "DDS domain; robots and the vendor's programs use 0"});
  a.Key(UNDERSTUDY_NVP(c.partition),
        {"DDS partition of all topics; programs must name it too; \"\" is the one that they have "
         "without"});
  a.Choice(UNDERSTUDY_NVP(c.video),
           {"When cameras send video: joined, while a program of this machine reads 230.1.1.1 on "
            "that interface; always; off, also none to video_topic"},
           {"joined", "always", "off"});
}

void DescribeGuard(Archive& a, GuardConfig& c) {
  a.Key(UNDERSTUDY_NVP(c.listen_loopback),
        {"s",
         {0, 10},
         "Wall time to listen for another robot on lo before publishing (the default is "
         "assumed)"});
  a.Key(UNDERSTUDY_NVP(c.listen_network),
        {"s", {0, 60}, "The same on every other interface (the default is assumed)"});
  a.Choice(UNDERSTUDY_NVP(c.on_stranger),
           {"What to do when another robot publishes after the start; warn also starts beside a "
            "writer of rt/lowstate that has not published"},
           {"silence", "warn", "stop"});
}

void DescribeControl(Archive& a, ControlConfig& c) {
  a.Key(UNDERSTUDY_NVP(c.panel), {"Serve the panel and the routes of ctl over TCP, for a browser"});
  a.Key(UNDERSTUDY_NVP(c.address),
        {"IP address to serve it on; others than this machine's own can reach the robot "
         "on any but 127.0.0.1 and ::1"});
  a.Key(UNDERSTUDY_NVP(c.port),
        {"", {0, 65535}, "TCP port; 0 is 7707 + `domain`, or the next free one above (assumed)"});
}

void DescribeTime(Archive& a, TimeConfig& c) {
  a.Key(UNDERSTUDY_NVP(c.speed),
        {"s/s", {0, 1000}, "Simulated time per wall time; 0 is as fast as possible"});
  a.Key(UNDERSTUDY_NVP(c.duration),
        {"s", kNotNegative, "Simulated time after which the run ends; 0 is never"});
  a.Key(UNDERSTUDY_NVP(c.realtime), {"Ask for real-time scheduling and locked memory"});
}

void DescribeRecording(Archive& a, RecordingConfig& c) {
  a.Key(UNDERSTUDY_NVP(c.ros_hz),
        {"Hz",
         {0, 1000},
         "Rate of /tf, /joint_states and /clock in recordings, at most that of LowState; 0 leaves "
         "them, /robot_description and /scene out (the default is assumed)"});
}

void DescribePhysics(Archive& a, PhysicsConfig& c) {
  a.Key(UNDERSTUDY_NVP(c.timestep),
        {"s", {0.0001, 0.01}, "Physics step and period of the motor law (the default is assumed)"});
  a.Choice(
      UNDERSTUDY_NVP(c.contacts),
      {"Contacts as the model of the robot has them, or pyramids in place of friction cones: for "
       "training, several times as fast for a Go2"},
      {"model", "pyramid"});
  a.Choice(UNDERSTUDY_NVP(c.on_divergence), {"What to do when the physics diverges"},
           {"stop", "reset"});
}

void DescribeGate(Archive& a, authority::GateConfig& c) {
  a.Choice(Named{"mode", &c.lenient},
           {"Whether a command that is wrong in form (crc, head, mode_machine, mode_pr, "
            "motor mode) is refused or counted and taken"},
           {"strict", "lenient"});
  a.Key(UNDERSTUDY_NVP(c.timeout),
        {"s",
         {0.001, 3600},
         "Simulated time without a taken command until the motors damp (the default is assumed: no "
         "figure is published)"});
  a.Key(UNDERSTUDY_NVP(c.damping_kd),
        {"N·m·s/rad", {0, 100}, "Gain of that damping (the default is assumed)"});
}

void DescribeMotion(Archive& a, authority::MotionConfig& c) {
  a.Key(UNDERSTUDY_NVP(c.service),
        {"Motion service that is on at the start, by its alias in robot.services; none: rt/lowcmd "
         "moves the motors; \"\": the first that robot.firmware has"});
  a.Key(UNDERSTUDY_NVP(c.fight), {"Follow rt/lowcmd while a motion service is on: motors follow "
                                  "the latest command of either"});
}

void DescribeCrane(Archive& a, physics::CraneConfig& c) {
  a.Key(UNDERSTUDY_NVP(c.length),
        {"m", {0.05, 20}, "Tether between anchor and hook at the start (the default is assumed)"});
  a.Key(UNDERSTUDY_NVP(c.stiffness),
        {"N/m", {1, 1e6}, "Stiffness of the tether (the default is assumed)"});
  a.Key(UNDERSTUDY_NVP(c.damping),
        {"N·s/m", {0, 1e5}, "Damping of the tether while taut (the default is assumed)"});
  a.Key(UNDERSTUDY_NVP(c.speed),
        {"m/s", {0.001, 5}, "Speed of lowering and raising (the default is assumed)"});
}

void DescribeStart(Archive& a, StartConfig& c) {
  std::vector<std::string> words = StartPoses();
  words.insert(words.begin(), "");
  a.Word(UNDERSTUDY_NVP(c.pose), {"Pose the run starts in; \"\" is robot.default_start"}, words);
  a.Key(UNDERSTUDY_NVP(c.at),
        {"m, m, rad",
         {-kFurthestStart, kFurthestStart},
         "x, y and yaw in the world at the start and after a reset; a fixed base stays"});
  a.Key(UNDERSTUDY_NVP(c.boot),
        {"Whether the run begins at the power switch: motors limp, nothing sent or answered until "
         "the times of robot.boot; else the robot has booted"});
}

// Ranges and meanings are those of the request, so that scripts and this say the same.
void DescribeFault(Archive& a, robot::PlannedFault& f) {
  static const emulator::RequestRow& row = **emulator::FindRequest("fault");
  const auto about = [](std::string_view key) {
    const schema::Field& field = *std::ranges::find(row.fields, key, &schema::Field::key);
    return About(field.unit, field.range, field.does);
  };
  static const std::vector<std::string> kinds(std::next(robot::FaultNames().begin()),
                                              robot::FaultNames().end());
  a.Key(UNDERSTUDY_NVP(f.component), {"What has it, by its name in docs/reference/faults.md"});
  a.Word(UNDERSTUDY_NVP(f.fault), {"What is wrong with it"}, kinds);
  a.Key(UNDERSTUDY_NVP(f.by), about("by"));
  a.Key(UNDERSTUDY_NVP(f.at), {"s", {0, 1e6}, "Simulated time at which it begins"});
  a.Key(Named{"for", &f.times.lasts}, about("for"));
  a.Key(UNDERSTUDY_NVP(f.times.ramp), about("ramp"));
  a.Key(UNDERSTUDY_NVP(f.times.probability), about("probability"));
}

// The keys of a robot, of which those of the world stand in between.
void DescribeProfile(Archive& a, RobotConfig& c) {
  a.Key(UNDERSTUDY_NVP(c.profile),
        {"How good the sensors are: a name in config/profiles, whose values of `sensors` lie below "
         "all that --config and --set say; \"\" is nominal"});
  a.Key(UNDERSTUDY_NVP(c.look),
        {"A copy of unitree_ros or unitree_mujoco, or MJCF or URDF, whose visual meshes draw the "
         "robot (docs/reference/looking.md); \"\": the model's own shapes"});
}

void DescribeWhere(Archive& a, RobotConfig& c) {
  a.Section(UNDERSTUDY_NVP(c.network), {"The network of robot and programs"}, DescribeNetwork);
}

void DescribeRun(Archive& a, RobotConfig& c) {
  a.Section(UNDERSTUDY_NVP(c.sensors),
            {"How sensors err (docs/reference/sensors.md); the values of `profile` come before "
             "others but those of the robot's file"},
            DescribeSensors);
  a.Section(UNDERSTUDY_NVP(c.gate), {"Which commands the motors follow"}, DescribeGate, "mode");
  a.Section(UNDERSTUDY_NVP(c.motion), {"The robot's motion service"}, DescribeMotion, "service");
  a.Section(UNDERSTUDY_NVP(c.crane), {"The tether a robot hangs from"}, DescribeCrane);
  a.Section(UNDERSTUDY_NVP(c.start), {"How a run begins"}, DescribeStart);
  a.List(UNDERSTUDY_NVP(c.faults),
         {"What is wrong with the robot from the start or from some time on "
          "(docs/reference/faults.md)"},
         DescribeFault);
}

void DescribeSpec(Archive& a, RobotConfig& c) {
  a.Section(Named{"robot", &c.spec},
            {"Description of the robot; config/robots has one file per robot"}, Describe);
}

void DescribeWorld(Archive& a, Config& c) {
  a.Section(UNDERSTUDY_NVP(c.guard), {"Protection of other robots on the network"}, DescribeGuard);
  a.Section(UNDERSTUDY_NVP(c.control), {"The panel's address"}, DescribeControl);
  a.Section(UNDERSTUDY_NVP(c.time), {"How time passes"}, DescribeTime);
  a.Section(UNDERSTUDY_NVP(c.recording), {"What recordings have for ROS and viewers"},
            DescribeRecording);
  a.Section(UNDERSTUDY_NVP(c.physics), {"How physics is computed"}, DescribePhysics);
}

void DescribeChance(Archive& a, Config& c) {
  a.Section(UNDERSTUDY_NVP(c.randomization),
            {"Quantities drawn at random at the start, each from [least, most]; [] leaves it "
             "(docs/reference/randomization.md)"},
            DescribeRandomization);
}

void DescribeRobots(Archive& a, std::vector<RobotConfig>& robots) {
  for (RobotConfig& robot : robots) {
    a.Section(
        Named{robot.name, &robot}, {"A robot"}, +[](Archive& one, RobotConfig& c) {
          DescribeProfile(one, c);
          DescribeWhere(one, c);
          DescribeRun(one, c);
          DescribeSpec(one, c);
        });
  }
}

}  // namespace

const std::vector<std::string>& StartPoses() {
  static const std::vector<std::string> kPoses(robot::kStartPoses.begin(),
                                               robot::kStartPoses.end());
  return kPoses;
}

void Describe(Archive& a, Config& c) {
  const bool alone = c.robots.size() == 1;
  if (alone) DescribeProfile(a, c.robots[0]);
  DescribeScene(a, c);
  if (alone) DescribeWhere(a, c.robots[0]);
  DescribeWorld(a, c);
  if (alone) DescribeRun(a, c.robots[0]);
  DescribeChance(a, c);
  if (alone) {
    DescribeSpec(a, c.robots[0]);
  } else {
    a.Section(UNDERSTUDY_NVP(c.robots),
              {"The robots of the world, by name (docs/reference/several.md)"}, DescribeRobots);
  }
}

const std::vector<std::string>& RobotConfigKeys() {
  static const std::vector<std::string> kKeys = {"profile", "look",  "network", "sensors", "gate",
                                                 "motion",  "crane", "start",   "faults",  "robot"};
  return kKeys;
}

}  // namespace understudy::config
