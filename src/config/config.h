// The configuration of a run, with its defaults. config/keys.cc has one row per key: name, unit,
// range, meaning.
#pragma once

#include <string>
#include <vector>

#include "authority/command_gate.h"
#include "authority/motion_config.h"
#include "objects/object_kinds.h"
#include "physics/crane.h"
#include "robot/fault_bank.h"
#include "robot/randomization.h"
#include "robot/robot_spec.h"
#include "sensors/sensor_config.h"
#include "terrain/terrain.h"

namespace understudy::config {

// When a robot sends the video streams of its cameras. kJoined: while a program of this machine
// reads them on the robot's interface.
enum class VideoSending { kJoined, kAlways, kOff };

struct NetworkConfig {
  std::string interface = "lo";
  int domain = 0;
  std::string partition;  // of DDS, in which all topics are; "" is the usual one
  VideoSending video = VideoSending::kJoined;
};

// What to do when another robot publishes on this network after the start. kWarn also lets a run
// start beside a writer of rt/lowstate that has not published yet.
enum class StrangerAction { kSilence, kWarn, kStop };

struct GuardConfig {
  double listen_loopback = 0.2;  // s to listen for another robot before publishing, on lo
  double listen_network = 1;     // s, on any other interface; both assumed
  StrangerAction on_stranger = StrangerAction::kSilence;
};

struct TimeConfig {
  double speed = 1;      // simulated seconds per wall second; 0 = as fast as possible
  double duration = 0;   // simulated s after which the run ends; 0 = never
  bool realtime = true;  // ask for SCHED_FIFO and locked memory
};

// Where HTTP clients, such as a browser, reach the robot over TCP.
struct ControlConfig {
  bool panel = true;
  std::string address = "127.0.0.1";
  int port = 0;  // 0: 7707 + domain, or the next free one above
};

enum class DivergenceAction { kStop, kReset };

struct RecordingConfig {
  double ros_hz = 50;  // of /tf, /joint_states and /clock; 0: none of ROS's topics; assumed
};

// How contacts are computed: as the models say, or as physics::UsePyramids does.
enum class ContactModel { kModel, kPyramid };

struct PhysicsConfig {
  double timestep = 0.001;  // s; also the period of the motor law; assumed
  ContactModel contacts = ContactModel::kModel;
  DivergenceAction on_divergence = DivergenceAction::kStop;
};

inline constexpr double kFurthestStart = 1000;  // m, and rad of yaw

struct StartConfig {
  std::string pose;            // lying | standing | hanging | clamped; "" = robot.default_start
  std::array<double, 3> at{};  // x, y [m] and yaw [rad] in the world
  bool boot = false;           // begins at the power switch
};

// Of one robot.
struct RobotConfig {
  std::string name;     // in its world; as spec.name if it is alone
  std::string profile;  // of the sensors: a name in config/profiles
  std::string look;     // a file or folder whose visual meshes draw it; "" for its model's shapes
  NetworkConfig network;
  sensors::SensorConfig sensors;
  authority::GateConfig gate;
  authority::MotionConfig motion;
  physics::CraneConfig crane;
  StartConfig start;
  std::vector<robot::PlannedFault> faults;
  robot::RobotSpec spec;
};

// Of a world and its robots, one or more.
struct Config {
  // Before the names of a robot's bodies, joints and sites in the world's model; "" if it is alone.
  std::string PrefixOf(const RobotConfig& robot) const {
    return robots.size() == 1 ? "" : robot.name + "/";
  }

  GuardConfig guard;
  ControlConfig control;
  TimeConfig time;
  RecordingConfig recording;
  PhysicsConfig physics;
  std::string scene = "flat";  // a kind of terrain, "row", a name in models/scene or a path
  terrain::TerrainSpec terrain;
  std::vector<objects::ObjectSpec> objects;
  robot::RandomizationSpec randomization;
  std::vector<RobotConfig> robots = std::vector<RobotConfig>(1);
};

}  // namespace understudy::config
