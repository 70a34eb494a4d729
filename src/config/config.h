// Everything a run can be told, with its defaults. config/keys.cc holds one row per key: name,
// unit, range, meaning.
#ifndef UNDERSTUDY_CONFIG_CONFIG_H_
#define UNDERSTUDY_CONFIG_CONFIG_H_

#include <string>
#include <vector>

#include "robot/command_gate.h"
#include "robot/robot_spec.h"

namespace understudy {

struct NetworkConfig {
  std::string interface = "lo";
  int domain = 0;
};

// What to do when somebody else's robot appears on our network after we have started.
enum class StrangerAction { kSilence, kWarn, kStop };

struct GuardConfig {
  double listen = 0.2;  // s to listen for another robot before the first word
  StrangerAction on_stranger = StrangerAction::kSilence;
};

struct TimeConfig {
  double speed = 1;      // simulated seconds per wall second; 0 = as fast as possible
  double duration = 0;   // simulated s after which the run ends; 0 = never
  bool realtime = true;  // ask for SCHED_FIFO and locked memory
};

enum class DivergenceAction { kStop, kReset };

struct PhysicsConfig {
  double timestep = 0.001;  // s; also the period of the motor law
  DivergenceAction on_divergence = DivergenceAction::kStop;
};

struct SensorConfig {
  bool quantise = true;
  bool noise = true;
  int seed = 1;
};

struct CraneConfig {
  double height = 0;  // m, of the anchor over the ground; 0 = as high as the hanging pose needs
  double stiffness = 20000;  // N/m of the tether
  double damping = 1000;     // N·s/m, only while it is taut
  double lower_speed = 0.1;  // m/s at which it is lowered or raised
};

struct StartConfig {
  std::string pose;  // damped | standing | hanging | clamped; "" = the robot's own
};

struct Config {
  NetworkConfig network;
  GuardConfig guard;
  TimeConfig time;
  PhysicsConfig physics;
  SensorConfig sensors;
  GateConfig gate;
  CraneConfig crane;
  StartConfig start;
  std::string scene = "flat";  // a name in models/scene or a path
  RobotSpec robot;
};

}  // namespace understudy

#endif  // UNDERSTUDY_CONFIG_CONFIG_H_
