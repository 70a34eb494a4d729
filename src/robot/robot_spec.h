// The description of a robot, read from config/robots/<robot>.yaml and constant afterwards. Each
// field is a YAML key of the same name; config/robot_keys.cc reads it and has its meaning, unit and
// range.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "robot/motion_spec.h"

namespace understudy::robot {

// The IDL family of the vendor for rt/lowcmd and rt/lowstate.
enum class WireFamily : std::uint8_t { kGo, kHg };

// The build of a robot. It selects the controller of the motion service and the names of its
// states. kOther has no controller and only damps.
enum class RobotKind : std::uint8_t { kOther, kQuadruped, kWheeled, kHumanoid };

// Returns whether it has a quadruped's four legs, with feet or wheels.
constexpr bool IsQuadruped(RobotKind kind) {
  return kind == RobotKind::kQuadruped || kind == RobotKind::kWheeled;
}

// A make of motor, which robots share (config/motors.yaml). Torques and rates are those of its own
// output.
struct MotorTypeSpec {
  std::string name{};
  double torque_limit = 0;     // N·m, by its limit of current
  double knee_speed = 0;       // rad/s up to which torque_limit is available
  double no_load_speed = 0;    // rad/s at which the driving torque is 0
  double rated_v = 0;          // V of the bus from which on these speeds hold; 0 = any
  double watt_per_nm2 = 0;     // W/(N·m)², loss of its winding at 25 °C
  double winding_c_per_w = 0;  // °C/W from winding to casing
  double casing_c_per_w = 0;   // °C/W from casing to air
  double winding_time = 20;    // s, time constant of the winding towards the casing
  double casing_time = 600;    // s, of the casing towards the air
};

// A motor of the body or of a hand. Only the body's have slot and q_clamp, only a hand's have
// lock_kd and span.
struct MotorSpec {
  std::string joint;         // MJCF joint
  int slot = 0;              // index in LowCmd.motor_cmd and LowState.motor_state
  double torque_limit = 0;   // N·m at the joint
  double knee_speed = 0;     // rad/s up to which torque_limit is available
  double no_load_speed = 0;  // rad/s at which the driving torque is 0
  std::string type{};        // of MotorTypeSpec; "" = one without losses
  double gear = 1;           // reduction from the motor's own output to the joint
  double q_step = 0;         // rad, encoder lattice; 0 = none
  double dq_step = 0;        // rad/s
  double tau_step = 0;       // N·m
  double hold_kp = 0;        // N·m/rad, gains that hold a start pose, or of a hand's controllers
  double hold_kd = 0;        // N·m·s/rad
  double zero_error = 0;     // rad that its encoder reads too much
  double armature = 0;       // kg·m², in place of the model's; 0 = the model's
  double strength = 1;       // actual over intended torque, also of the limit
  double kp_scale = 1;       // effective over commanded kp
  double kd_scale = 1;       // effective over commanded kd
  double lock_kd = 0;        // N·m·s/rad, damping while not enabled
  // rad, its angle where q of messages is 0 and where it is 1. 0, 0: q is the angle
  std::array<double, 2> span{0, 0};
  // rad, least and most commanded q that it follows: what is beyond is taken for the end. 0, 0: any
  std::array<double, 2> q_clamp{0, 0};
};

// Values of a body that differ from the model file; empty or 0 keeps the file's.
struct BodySpec {
  std::string name{};
  std::vector<double> pos{};      // m, in the parent's frame
  double mass = 0;                // kg
  std::vector<double> com{};      // m, centre of mass in the body's frame
  std::vector<double> inertia{};  // kg·m², xx yy zz xy xz yz about it, in the body's frame
};

// The position of a site that differs from the model file.
struct SiteSpec {
  std::string name{};
  Eigen::Vector3d pos{0, 0, 0};  // m, in its body's frame
};

// The source of joint friction, damping and armature: the model's file, or fits to recordings of
// real robots.
enum class DynamicsSource : std::uint8_t { kCatalogue, kFitted };

// Fitted values of some motors and their joints.
struct FittedDynamicsSpec {
  std::vector<int> slots{};  // the motors
  double armature = -1;      // kg·m² at the joint; below 0: as in the model
  double damping = -1;       // N·m·s/rad of the joint; below 0: as in the model
  double frictionloss = -1;  // N·m of the joint; below 0: as in the model
  double kd_share = 1;       // effective over commanded kd
};

struct DynamicsSpec {
  DynamicsSource use = DynamicsSource::kCatalogue;
  std::vector<FittedDynamicsSpec> fitted;
  double delay = 0;             // s from a command to its torque
  double backlash = 0;          // rad of play between each motor and its joint
  double ripple = 0;            // share by which the torque of each motor swings
  double ripple_periods = 100;  // of that in a turn of its joint; *assumed*
};

// Two serial joints driven by two parallel motors A and B. Indices in motor order.
struct ParallelSpec {
  int pitch = 0;          // the slot of B in AB mode
  int roll = 0;           // the slot of A in AB mode
  double roll_ratio = 1;  // difference of the angles of A and B per radian of roll
};

// A bus over which the robot's computer reaches motors of the body.
struct BusSpec {
  std::string name{};
  std::vector<int> slots{};       // of its motors
  std::array<double, 2> delay{};  // s that a command takes on it: least and most
};

// A fan in LowState; go only.
struct FanSpec {
  std::string name{};
  int place = 0;      // its index in fan_frequency
  double rpm = 0;     // reported while it turns
  int stall_bit = 0;  // of fan_frequency[3], set while it does not; 0 = none
};

// The mainboard's two thermometers, as a Go2's LowState shows them: temperature_ntc1 and ntc2.
struct BoardSpec {
  double centre_rise_c = 20;   // over the air, with all fans
  double charger_rise_c = 16;  // over the air, with all fans
  double still_air = 1.5;      // times that rise where no fan turns; *assumed*, as the next
  double time_constant = 120;  // s
};

// A pressure sensor of a hand: rows of cells on one of its links.
struct PadSpec {
  // MJCF site whose z axis leaves the skin; x goes along a row, y from a row to the one before it.
  // A box: its half lengths are those of the sensor. "": the sensor feels nothing.
  std::string site{};
  int rows = 3, columns = 4;
  std::vector<int> taxels{};  // of a Dex3-1: those of the 12 cells that there are
};

// What the cells of a hand's pads show.
struct TouchSpec {
  double hz = 0;                 // of its messages, where it has some of their own
  double counts_per_newton = 0;  // of the cell on which a contact sits
  double most_counts = 0;        // that a cell can show; 0: any
  double noise_counts = 0;       // standard deviation of a cell that feels something
  double spread = 0.002;         // m, standard deviation of the bell that a contact makes
};

// A hand with motors and topics, or two that share them.
struct HandSpec {
  std::string name{};                 // "left"
  std::string law = "dex3";           // a row of kHandLaws, robot/hand_law.h
  std::vector<std::string> models{};  // MJCF of wrists with hands: absolute, else below models/
  std::string topic{};                // as HandTopic in robot/hand_law.h takes it
  double hz = 500;                    // of its states
  // In the order of the messages. The index there is the id in the mode byte.
  std::vector<MotorSpec> motors{};
  int slot = 0;                 // of its first motor in the messages
  int slots = 0;                // of the messages; 0: as many as it has motors
  int sdk_slot = -1;            // of its first motor in rt/hand_sdk; -1: that does not reach it
  std::vector<PadSpec> pads{};  // in the order of the messages
  TouchSpec touch{};            // of the pads
  double timeout = 1;           // s without a command after which watched motors lock
  double temperature_c = 0;     // of the pads
  double supply_v = 0;          // V, supply voltage
};

struct FootSpec {
  std::string name;
  std::vector<std::string> geoms;  // MJCF geoms whose contacts are this foot's
  // Measured direction in the frame of the geoms' body; all 0 = the contact's normal.
  Eigen::Vector3d axis{0, 0, 1};
};

// A start pose: joint angles [rad] of the body in motor order, height of the base [m] over the
// ground, and its orientation as a quaternion w, x, y, z. Fingers start where the model has them.
struct PoseSpec {
  std::vector<double> q;
  double height = 0;
  std::array<double, 4> quat = {1, 0, 0, 0};
};

struct RateSpec {
  double lowstate_hz = 500;  // rt/lowstate, rt/secondary_imu
  double motion_hz = 500;    // rt/sportmodestate or rt/odommodestate; need divide no other
  double lf_hz = 20;         // all rt/lf/*
  double service_hz = 500;   // commands of the motion service
};

// A program on the robot's computer, as robot_state lists it.
struct ServiceSpec {
  std::string name{};
  std::string alias{};                 // its name in motion_switcher; "" if it moves no motors
  bool on = true;                      // at boot; for motion services motion.service decides
  bool protect = false;                // cannot be switched on or off
  std::string since{};                 // first firmware that has it; "" = any
  std::string before{};                // first firmware that no longer has it; "" = none
  std::string version{};               // as robot_state tells it; "" = not told
  std::string controller = "default";  // of a motion service: a row of motion/controllers.cc
  std::string policy{};                // definition that the controller policy plays: a YAML file
};

// rt/arm_sdk: commands blended with those of the motion service.
struct ArmSdkSpec {
  std::vector<int> slots{};        // of the motors it moves; empty if there is no rt/arm_sdk
  int weight_slot = 0;             // whose q is the weight
  bool weight_in_mode_pr = false;  // mode_pr is the weight in percent instead
  double timeout = 0;              // s after which a command expires; 0 = never
};

// A chord of the remote controller and its effect while a motion service is on.
struct ChordSpec {
  std::string keys{};       // "L2+B"
  int clicks = 1;           // of the last key
  std::string does{};       // a word of kChordActions, authority/chord.h
  double value = 0;         // id of a state or action; 0 if there is none
  std::vector<int> from{};  // ids of the states in which it works; empty = all
};

struct RemoteSpec {
  std::vector<ChordSpec> chords;
  Eigen::Vector3d speed{0, 0, 0};  // forward, left m/s, turn rad/s at full stick
};

// Lattice and noise of the IMUs. MotorSpec has those of encoders.
struct ImuSpec {
  std::string site;            // MJCF site of LowState's unit
  std::string secondary_site;  // "" if the robot has none
  double gyro_step = 0;        // rad/s
  double accel_step = 0;       // m/s²
  double gyro_noise = 0;       // rad/s, standard deviation
  double accel_noise = 0;      // m/s²
  double temperature_c = 0;    // what it shows when warm
};

// Standard deviation of motor readings at rest, in steps of the motor's lattice.
struct EncoderNoiseSpec {
  double q_steps = 0;
  double dq_steps = 0;
  double tau_steps = 0;
  double tau = 0;  // N·m, of the torque besides, the same for every motor
};

struct FootSensorSpec {
  double offset_counts = 0;  // raw value of an unloaded foot
  double counts_per_newton = 0;
};

// A lidar with topics below rt/utlidar.
struct LidarSpec {
  std::string make = "none";          // a row of perception/lidar_law.h
  std::string body{};                 // MJCF body that carries it; "": the base
  Eigen::Vector3d pos{0, 0, 0};       // m, its frame in the body's
  Eigen::Vector3d rpy{0, 0, 0};       // rad
  Eigen::Vector3d base_pos{0, 0, 0};  // m, in place of pos in rt/utlidar/cloud_base
  double noise = 0;                   // m, standard deviation of a range
  double dropout = 0;                 // share of echoes that are lost
  std::array<double, 2> range{0, 0};  // m, the nearest and the farthest echo
};

inline bool HasLidar(const LidarSpec& lidar) { return lidar.make != "none"; }
// Whether programs on the robot make clouds and maps in the base's frame of what it sees.
inline bool IsMapped(const LidarSpec& lidar) { return lidar.make == "L1" || lidar.make == "L2"; }

// A camera whose pictures a service gives. Its frame: x along the view, y to the left, z up.
struct CameraSpec {
  std::string name;
  std::string service;             // that gives its pictures, as in rt/api/<service>; "": none
  std::string body;                // of the model, that carries it; "": the base
  Eigen::Vector3d pos{0, 0, 0};    // m, its frame in the body's
  Eigen::Vector3d rpy{0, 0, 0};    // rad
  double baseline = 0;             // m, between its two eyes, left and right of that; 0: it has one
  int width = 1280, height = 720;  // pixels, of an eye
  std::array<double, 2> focal{864, 864};         // pixels, across and down
  std::array<double, 2> centre{640, 360};        // pixels, the picture of its axis
  std::array<double, 4> distortion{0, 0, 0, 0};  // k1, k2, p1, p2 (robot/lens.h)
  int quality = 90;                              // of its JPEGs, 1 to 100
  std::array<double, 2> depth{0, 0};             // m, nearest and farthest; 0, 0: it has none
  int video_port = 0;                            // UDP port of its video stream; 0: it has none
  std::string video_topic;                       // of Go2FrontVideoData_, with its frames; "": none
  double video_hz = 13.8;                        // frames per second
};
inline bool HasDepth(const CameraSpec& camera) { return camera.depth[1] > 0; }
inline bool IsBinocular(const CameraSpec& camera) { return camera.baseline > 0; }
// Pictures of two eyes stand side by side.
inline int PictureWidth(const CameraSpec& camera) {
  return IsBinocular(camera) ? 2 * camera.width : camera.width;
}
// The model's camera of the right eye; that of the left one has the camera's own name.
inline std::string RightEyeName(const CameraSpec& camera) { return camera.name + "_right"; }

struct BatterySpec {
  int cells = 0;
  double capacity_ah = 0;
  double start_soc = 0.9;  // 0..1
  // V of an unloaded cell at charges of 0, 0.1 ... 1, straight between. Derived: 4.084 V at 93 %
  // and 0.939 A, 3.837 V at 63 % and 3.627 A of two Go2, 3.66 V at 41 % and 2.1 A of a G1, whose
  // charger ends at 54 V for 13 cells (docs/dev/sources.md#go2-captures, #notes-on-real-robots),
  // with 10 mohm per cell. *Assumed* below 40 % and between, as cells of that chemistry (NMC) go.
  std::array<double, 11> cell_v = {3.0,  3.42,  3.53,  3.6,   3.67, 3.76,
                                   3.85, 3.925, 3.995, 4.068, 4.154};
  double internal_ohm = 0;      // of the pack
  double idle_a = 0;            // drawn with all motors passive
  double most_a = 0;            // A that it gives at most, as the drives share it; 0 = any
  double cutoff_a = 0;          // A, mean over cutoff_time, beyond which it cuts off; 0 = never
  double cutoff_v = 0;          // V, mean of its weakest cell, below which it cuts off; 0 = never
  double cutoff_time = 5;       // s
  double low_soc = 0.2;         // charge below which it is reported as low
  double cell_spread = 0.001;   // V, standard deviation of cells; 0 = all alike
  double rise_per_w_c = 0;      // °C/W, steady rise over the air per W of loss in the pack
  double time_constant = 1800;  // s, of that rise
};

// When what works after the power switch, s of simulated time. Defaults are *assumed*.
struct BootSpec {
  double states = 25;    // states are sent and commands heard
  double services = 30;  // the first service answers, then one after the other
  double motion = 45;    // all services answer, and the motion service starts
};

struct ThermalSpec {
  double ambient_c = 25;
  double rest_rise_c = 0;  // of an idle motor above ambient
  double derate_c = 105;   // of a winding from which on its motor gives less torque
  double trip_c = 120;     // of a winding at which its motor gives no torque
};

inline constexpr std::size_t kMostHands = 2;
inline constexpr int kHandSdkMotors = 4;  // of a message of rt/hand_sdk (the vendor's page)

struct RobotSpec {
  std::string name;
  std::string description;
  std::string model;      // MJCF: absolute, else below models/
  std::string base_body;  // MJCF body with the free joint
  RobotKind kind = RobotKind::kOther;
  WireFamily family = WireFamily::kGo;
  std::string firmware;  // version of the simulated software
  // First firmware that publishes the id of the state machine's state: go in error_code of
  // SportModeState, hg on rt/sportmodestate. "" = none.
  std::string state_id_since;
  std::string revision;                    // hardware revision, "" if the file has none
  int mode_machine = 0;                    // hg only: in LowState, and required in LowCmd
  std::vector<std::string> locked_joints;  // have no motor and cannot move
  std::vector<BodySpec> bodies;            // that differ from the model file
  std::vector<SiteSpec> sites;             // that differ from the model file
  std::vector<MotorTypeSpec> motor_types;  // all makes, whichever it has
  std::vector<MotorSpec> motors;           // the body's, in ascending slot
  std::vector<ParallelSpec> parallel;
  DynamicsSpec dynamics;
  std::vector<BusSpec> buses;
  std::vector<FanSpec> fans;  // go only
  BoardSpec board;
  std::vector<std::string> hand_makes;  // names of config/hands that it can bear
  std::string hand_make = "none";       // which it bears, by side (config/hand_choice.h)
  std::vector<HandSpec> hands;          // hg only, at most kMostHands
  // s after which a command of rt/hand_sdk expires; 0 = never. *assumed*: the vendor's example
  // writes once a second
  double hand_sdk_timeout = 2;
  ImuSpec imu;
  EncoderNoiseSpec encoder_noise;
  std::vector<FootSpec> feet;  // FR FL RR RL for quadrupeds: the order of foot_force
  FootSensorSpec foot_sensor;
  LidarSpec lidar;
  std::vector<CameraSpec> cameras;
  RateSpec rates;
  std::vector<ServiceSpec> services;
  // Services that answer requests: names of tables, services::kApiNames.
  std::vector<std::string> apis = {"motion_switcher", "config", "robot_state"};
  // Topics of texts that its programs tell by themselves: rows of services/status_texts.cc.
  std::vector<std::string> status_texts;
  bool error_list = false;        // rt/errorlist; go only
  bool arm_action_state = false;  // rt/arm/action/state; hg only
  ArmSdkSpec arm_sdk;
  bool user_lowcmd = false;  // whether the motion service can hand the motors to rt/user_lowcmd
  RemoteSpec remote;
  BatterySpec battery;
  BootSpec boot;
  ThermalSpec thermal;
  PoseSpec lying;  // on the ground, passive
  PoseSpec standing;
  PoseSpec hanging;  // on the crane or clamped; height is that of the base
  MotionSpec motion;
  std::string crane_body;                // MJCF body of the crane's hook
  Eigen::Vector3d crane_point{0, 0, 0};  // m, hook in that body's frame
  std::string default_start;             // lying | standing | hanging | clamped
};

// Whether rt/hand_sdk reaches a hand of the robot.
inline bool HasHandSdk(const RobotSpec& spec) {
  return std::ranges::any_of(spec.hands, [](const HandSpec& hand) { return hand.sdk_slot >= 0; });
}

// Returns the type of that name, null if there is none.
inline const MotorTypeSpec* FindMotorType(const RobotSpec& spec, const std::string& name) {
  for (const MotorTypeSpec& type : spec.motor_types) {
    if (type.name == name) return &type;
  }
  return nullptr;
}

// Returns pointers to all motors of `spec`, a RobotSpec that may be const, in motor order: the
// body's, then those of each hand.
template <class Spec>
auto AllMotors(Spec& spec) {
  std::vector<decltype(spec.motors.data())> all;
  for (auto& motor : spec.motors) all.push_back(&motor);
  for (auto& hand : spec.hands) {
    for (auto& motor : hand.motors) all.push_back(&motor);
  }
  return all;
}

}  // namespace understudy::robot
