// Everything a run can be told, with its defaults. config/keys.cc holds one row per key: name,
// unit, range, meaning.
#pragma once

#include <string>
#include <vector>

#include "authority/command_gate.h"
#include "authority/motion_config.h"
#include "physics/crane.h"
#include "robot/randomization.h"
#include "robot/robot_spec.h"
#include "sensors/sensors.h"
#include "terrain/terrain.h"

namespace understudy::config {

struct NetworkConfig {
  std::string interface = "lo";
  int domain = 0;
};

// What to do when somebody else's robot speaks on our network after we have started. kWarn also
// lets a run start beside a writer of rt/lowstate that has not spoken.
enum class StrangerAction { kSilence, kWarn, kStop };

struct GuardConfig {
  double listen_loopback = 0.2;  // s to listen for another robot before the first word, on lo
  double listen_network = 1;     // s, on any other interface; both assumed
  StrangerAction on_stranger = StrangerAction::kSilence;
};

struct TimeConfig {
  double speed = 1;      // simulated seconds per wall second; 0 = as fast as possible
  double duration = 0;   // simulated s after which the run ends; 0 = never
  bool realtime = true;  // ask for SCHED_FIFO and locked memory
};

// Where a robot is reached by what speaks TCP, a browser above all.
struct ControlConfig {
  bool panel = true;
  std::string address = "127.0.0.1";
  int port = 0;  // 0: the first that is free from 7707 on
};

enum class DivergenceAction { kStop, kReset };

struct PhysicsConfig {
  double timestep = 0.001;  // s; also the period of the motor law; assumed
  DivergenceAction on_divergence = DivergenceAction::kStop;
};

struct StartConfig {
  std::string pose;  // lying | standing | hanging | clamped; "" = the robot's own
};

struct Config {
  NetworkConfig network;
  GuardConfig guard;
  ControlConfig control;
  TimeConfig time;
  PhysicsConfig physics;
  sensors::SensorConfig sensors;
  authority::GateConfig gate;
  authority::MotionConfig motion;
  physics::CraneConfig crane;
  StartConfig start;
  std::string scene = "flat";  // a kind of terrain, row, a name in models/scene or a path
  terrain::TerrainSpec terrain;
  robot::RandomizationSpec randomization;
  robot::RobotSpec robot;
};

}  // namespace understudy::config
