// What a robot is: read from config/robots/<robot>.yaml, never changed afterwards. Every field is a
// YAML key of the same name; meaning, unit, range and default of each stand in
// config/robot_keys.cc, which reads them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace understudy::robot {

// Which of the vendor's two IDL families the robot speaks on rt/lowcmd and rt/lowstate.
enum class WireFamily : std::uint8_t { kGo, kHg };

// What it is built as: whose legs and wheels it has, and by that which controller can play its
// motion service and which words its states have. kOther has none of these: it only damps.
enum class RobotKind : std::uint8_t { kOther, kQuadruped, kWheeled, kHumanoid };

// Whether it has a quadruped's four legs, with feet or wheels.
constexpr bool IsQuadruped(RobotKind kind) {
  return kind == RobotKind::kQuadruped || kind == RobotKind::kWheeled;
}

// A motor of the body or of a hand; slot and hold gains are the body's alone, lock_kd a hand's.
struct MotorSpec {
  std::string joint;          // MJCF joint
  int slot = 0;               // index in LowCmd.motor_cmd and LowState.motor_state
  double torque_limit = 0;    // N·m at the joint
  double knee_speed = 0;      // rad/s up to which torque_limit is to be had
  double no_load_speed = 0;   // rad/s at which no driving torque is left
  double q_step = 0;          // rad, encoder lattice; 0 = none
  double dq_step = 0;         // rad/s
  double tau_step = 0;        // N·m
  double hold_kp = 0;         // N·m/rad, gains that hold a start pose
  double hold_kd = 0;         // N·m·s/rad
  double armature = 0;        // kg·m², in place of the model's; 0 = the model's
  double strength = 1;        // torque given over torque meant, before and at the limit
  double kp_scale = 1;        // how much of a commanded kp acts
  double kd_scale = 1;        // likewise of kd
  double rise_per_nm2_c = 0;  // °C/(N·m)², in place of ThermalSpec's; 0 = that
  double lock_kd = 0;         // N·m·s/rad with which it brakes while not enabled
};

// Where a body is otherwise than the model file has it; empty or 0 = as there.
struct BodySpec {
  std::string name{};
  std::vector<double> pos{};      // m, in the parent's frame
  double mass = 0;                // kg
  std::vector<double> com{};      // m, centre of mass in the body's frame
  std::vector<double> inertia{};  // kg·m², xx yy zz xy xz yz about it, in the body's frame
};

// Where a site is otherwise than the model file has it.
struct SiteSpec {
  std::string name{};
  Eigen::Vector3d pos{0, 0, 0};  // m, in its body's frame
};

// Whose figures hold for joints and drives: those of the model's file, or of fits to recordings of
// real robots.
enum class DynamicsSource : std::uint8_t { kCatalogue, kFitted };

// What such a fit says of some motors and their joints.
struct FittedDynamicsSpec {
  std::vector<int> slots{};  // the motors
  double armature = -1;      // kg·m² at the joint; below 0: as in the model
  double damping = -1;       // N·m·s/rad of the joint, likewise
  double frictionloss = -1;  // N·m of the joint, likewise
  double kd_share = 1;       // how much of a commanded kd acts
};

struct DynamicsSpec {
  DynamicsSource use = DynamicsSource::kCatalogue;
  std::vector<FittedDynamicsSpec> fitted;
  double delay = 0;  // s from when a command is followed to its torque
};

// Two serial joints driven by two parallel motors A and B. Indices in motor order.
struct ParallelSpec {
  int pitch = 0;          // the slot of B in AB mode
  int roll = 0;           // the slot of A in AB mode
  double roll_ratio = 1;  // how far A and B part per radian of roll
};

// A place of a hand that feels pressure.
struct PadSpec {
  std::vector<int> taxels{};  // the ones it has, of the message's 12
};

// A hand with motors of its own, on topics of its own.
struct HandSpec {
  std::string name{};   // "left"
  std::string topic{};  // between rt/ and /cmd, /state; rt/lf/ and /state
  // In the order of motor_cmd, their place there being the id in their mode byte.
  std::vector<MotorSpec> motors{};
  std::vector<PadSpec> pads{};  // in the order of press_sensor_state
  double timeout = 1;           // s without a command until watched motors lock
  double temperature_c = 0;     // what pads show
  double supply_v = 0;          // what it is fed with
};

struct FootSpec {
  std::string name;
  std::vector<std::string> geoms;  // MJCF geoms whose contacts are this foot's
  // Direction the sensor feels, in the frame of the geoms' body; all 0 = the contact's own normal.
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
  double motion_hz = 500;    // rt/sportmodestate or rt/odommodestate
  double hand_hz = 500;      // states of hands; assumed
  double lf_hz = 20;         // all rt/lf/*
  double service_hz = 500;   // commands of the robot's own motion service
};

// A program on the robot's own computer, as robot_state lists it.
struct ServiceSpec {
  std::string name{};
  std::string alias{};   // motion_switcher's word for it; "" when it moves no motors
  bool on = true;        // at boot; of motion services, motion.service says which is on
  bool protect = false;  // refuses to be switched
  std::string since{};   // firmware from which on it is there; "" = always
  std::string before{};  // firmware from which on it is gone; "" = never
};

// rt/arm_sdk: commands mixed over those of the motion service.
struct ArmSdkSpec {
  std::vector<int> slots{};        // motors it acts on, by slot; none where there is no arm_sdk
  int weight_slot = 0;             // whose q is the weight
  bool weight_in_mode_pr = false;  // mode_pr is the weight in percent instead
  double timeout = 0;              // s after which an old command no longer counts; 0 = never
};

// What a chord of the remote controller does while the motion service is on.
struct ChordSpec {
  std::string keys{};       // "L2+B"
  int clicks = 1;           // of the last key
  std::string does{};       // a word of kChordActions, authority/chord.h
  double value = 0;         // state id, action id; 0 where there is none
  std::vector<int> from{};  // ids of states it works in; none = in all
};

struct RemoteSpec {
  std::vector<ChordSpec> chords;
  Eigen::Vector3d speed{0, 0, 0};  // forward, left m/s, turn rad/s of fully moved sticks
};

// Lattice and noise of the inertial unit; encoder lattices are MotorSpec's.
struct ImuSpec {
  std::string site;            // MJCF site of LowState's unit
  std::string secondary_site;  // "" where the robot has none
  double gyro_step = 0;        // rad/s
  double accel_step = 0;       // m/s²
  double gyro_noise = 0;       // rad/s, standard deviation
  double accel_noise = 0;      // m/s²
  double temperature_c = 0;    // what it shows when warm
};

// Standard deviation of motor readings at rest, in steps of the motor's own lattice.
struct EncoderNoiseSpec {
  double q_steps = 0;
  double dq_steps = 0;
  double tau_steps = 0;
};

struct FootSensorSpec {
  double offset_counts = 0;  // raw value of an unloaded foot
  double counts_per_newton = 0;
};

struct BatterySpec {
  int cells = 0;
  double capacity_ah = 0;
  double start_soc = 0.9;  // 0..1
  double cell_full_v = 4.2;
  double cell_empty_v = 3.2;
  double internal_ohm = 0;  // of the pack
  double idle_a = 0;        // drawn with all motors passive
  double watt_per_nm2 = 0;  // heat per square of joint torque, over all motors
};

struct ThermalSpec {
  double ambient_c = 25;
  double rest_rise_c = 0;      // how much warmer an idle motor is
  double rise_per_nm2_c = 0;   // steady rise per (N·m)² of that motor
  double time_constant = 600;  // s
};

// The state machine of a humanoid's own motion service, by the vendor's numbers; -1 or empty where
// the robot has no such state.
struct HumanoidMotionSpec {
  int lock_stand = -1;            // joints locked, standing
  std::vector<int> balance{};     // standing balanced, the first one when none is named
  int squat = -1;                 // joints locked in squat_q
  int sit = -1;                   // joints locked in sit_q
  int balanced_squat = -1;        // from standing into squat_q and back, balanced
  std::vector<int> unplayed{};    // what the robot has and nothing here plays
  std::vector<double> squat_q{};  // rad, motor order
  std::vector<double> sit_q{};
  bool arm_actions = false;  // waves, shakes hands ...
};

// How a quadruped walks. Axes of the vectors are forward and left m/s, turn rad/s.
struct WalkSpec {
  std::array<double, 2> period = {0.5, 0.5};  // s of a stride, at rest and at most_speed forwards
  std::array<double, 2> duty = {0.55, 0.55};  // part of it that a foot stands, likewise
  double foot_raise = 0.08;                   // m that a swinging foot is lifted by
  double friction = 0.5;                      // of the ground that it counts on
  Eigen::Vector3d least_speed{-1, -0.4, -1};  // what it takes of a command
  Eigen::Vector3d most_speed{1, 0.4, 1};      // likewise
  Eigen::Vector3d dead_band{0, 0, 0};         // commands within are none
  Eigen::Vector3d gain{1, 1, 1};              // of the velocity on the command
  Eigen::Vector3d time_constant{0.4, 0.4, 0.4};  // s in which the velocity follows
  double dead_time = 0;                          // s until it begins to
  double turn_scrub = 1;                         // of wheels: how much faster they run in a turn
};

// How the motion service of a quadruped stands and moves.
struct QuadrupedMotionSpec {
  double stand_height = 0;                      // m, of the base over the ground
  double foot_x = 0;                            // m, how far the feet stand ahead of the hips
  std::array<double, 2> height_range = {0, 0};  // m about stand_height
  Eigen::Vector3d euler_range{0, 0, 0};         // rad either way: roll, pitch, yaw
  Eigen::Vector3d sit{0, 0, 0};  // m ahead, m over stand_height, rad of pitch: of the base
  double kp = 1;                 // N·m/rad at the legs' joints
  double kd = 0;                 // N·m·s/rad
  double damping_kd = 0;         // N·m·s/rad when damped, at all joints
  double wheel_kp = 0;           // N·m/rad that keeps a balanced robot's wheels where they stand
  double wheel_kd = 0;           // N·m·s/rad that brakes them
  WalkSpec walk;
};

// What the robot's own motion service is like.
struct MotionSpec {
  HumanoidMotionSpec humanoid;
  QuadrupedMotionSpec quadruped;
};

inline constexpr std::size_t kMostHands = 2;

struct RobotSpec {
  std::string name;
  std::string description;
  std::string model;      // MJCF: absolute, else below models/
  std::string base_body;  // MJCF body with the free joint
  RobotKind kind = RobotKind::kOther;
  WireFamily family = WireFamily::kGo;
  std::string firmware;  // version of the software that is played
  // Firmware from which on states are told by the state machine's id: in go's SportModeState in
  // error_code, in hg in a message of its own. "" = never.
  std::string state_id_since;
  std::string revision;  // of the hardware: one of the file's revisions, "" where it has none
  int mode_machine = 0;  // hg only: what LowState announces and LowCmd must echo
  std::vector<std::string> locked_joints;  // have no motor and cannot move
  std::vector<BodySpec> bodies;            // that differ from the model file
  std::vector<SiteSpec> sites;             // that differ from the model file
  std::vector<MotorSpec> motors;           // the body's, in ascending slot
  std::vector<ParallelSpec> parallel;
  DynamicsSpec dynamics;
  std::vector<HandSpec> hands;  // hg only, at most kMostHands
  ImuSpec imu;
  EncoderNoiseSpec encoder_noise;
  std::vector<FootSpec> feet;  // FR FL RR RL for quadrupeds: the order of foot_force
  FootSensorSpec foot_sensor;
  RateSpec rates;
  std::vector<ServiceSpec> services;
  // What answers requests: names of tables, of services::kApis.
  std::vector<std::string> apis = {"motion_switcher", "config", "robot_state"};
  bool arm_action_state = false;  // rt/arm/action/state; hg only
  ArmSdkSpec arm_sdk;
  bool user_lowcmd = false;  // rt/user_lowcmd, which its motion service can hand the motors to
  RemoteSpec remote;
  BatterySpec battery;
  ThermalSpec thermal;
  PoseSpec lying;  // on the ground, passive
  PoseSpec standing;
  PoseSpec hanging;  // on the crane or clamped; height is that of the base
  MotionSpec motion;
  std::string crane_body;                // MJCF body the crane's hook is in
  Eigen::Vector3d crane_point{0, 0, 0};  // m, hook in that body's frame
  std::string default_start;             // lying | standing | hanging | clamped
};

// All motors of a robot, in motor order: the body's, then hand by hand. They point into `spec`, a
// RobotSpec that may be const.
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
