// The description of a robot, read from config/robots/<robot>.yaml and constant afterwards. Each
// field is a YAML key of the same name; config/robot_keys.cc reads it and has its meaning, unit and
// range.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "robot/protection.h"

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

// A motor of the body or of a hand. Only the body's have slot and hold gains, only a hand's have
// lock_kd.
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
  double hold_kp = 0;        // N·m/rad, gains that hold a start pose
  double hold_kd = 0;        // N·m·s/rad
  double zero_error = 0;     // rad that its encoder reads too much
  double armature = 0;       // kg·m², in place of the model's; 0 = the model's
  double strength = 1;       // actual over intended torque, also of the limit
  double kp_scale = 1;       // effective over commanded kp
  double kd_scale = 1;       // effective over commanded kd
  double lock_kd = 0;        // N·m·s/rad, damping while not enabled
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
  double damping = -1;       // N·m·s/rad of the joint, likewise
  double frictionloss = -1;  // N·m of the joint, likewise
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

// A fan as LowState tells of it; go only.
struct FanSpec {
  std::string name{};
  int place = 0;      // its index in fan_frequency
  double rpm = 0;     // as told while it turns
  int stall_bit = 0;  // of fan_frequency[3], set while it does not; 0 = none
};

// The mainboard's two thermometers, as a Go2's LowState shows them: temperature_ntc1 and ntc2.
struct BoardSpec {
  double centre_rise_c = 20;   // over the air, with all fans
  double charger_rise_c = 16;  // likewise
  double still_air = 1.5;      // times that rise where no fan turns; *assumed*, as the next
  double time_constant = 120;  // s
};

// A pressure sensor of a hand.
struct PadSpec {
  std::vector<int> taxels{};  // indices of its taxels among the message's 12
};

// A hand with motors and topics.
struct HandSpec {
  std::string name{};   // "left"
  std::string topic{};  // between rt/ and /cmd, /state; rt/lf/ and /state
  // In the order of motor_cmd. The index there is the id in the mode byte.
  std::vector<MotorSpec> motors{};
  std::vector<PadSpec> pads{};  // in the order of press_sensor_state
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
  double hand_hz = 500;      // states of hands; assumed
  double lf_hz = 20;         // all rt/lf/*
  double service_hz = 500;   // commands of the motion service
};

// A program on the robot's computer, as robot_state lists it.
struct ServiceSpec {
  std::string name{};
  std::string alias{};    // its name in motion_switcher; "" if it moves no motors
  bool on = true;         // at boot; for motion services motion.service decides
  bool protect = false;   // cannot be switched on or off
  std::string since{};    // first firmware that has it; "" = any
  std::string before{};   // first firmware that no longer has it; "" = none
  std::string version{};  // as robot_state tells it; "" = not told
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

struct BatterySpec {
  int cells = 0;
  double capacity_ah = 0;
  double start_soc = 0.9;  // 0..1
  // V of an unloaded cell at charges of 0, 0.1 ... 1, straight between. Derived: 4.084 V at 93 %
  // and 0.939 A, 3.837 V at 63 % and 3.627 A of two Go2, 3.66 V at 41 % and 2.1 A of a G1, whose
  // charger ends at 54 V for 13 cells (docs/sources.md#go2-captures, #notes-on-real-robots), with
  // 10 mohm per cell. *Assumed* below 40 % and between, as cells of that chemistry (NMC) go.
  std::array<double, 11> cell_v = {3.0,  3.42,  3.53,  3.6,   3.67, 3.76,
                                   3.85, 3.925, 3.995, 4.068, 4.154};
  double internal_ohm = 0;      // of the pack
  double idle_a = 0;            // drawn with all motors passive
  double most_a = 0;            // A that it gives at most, as the drives share it; 0 = any
  double cutoff_a = 0;          // A, mean over cutoff_time, beyond which it cuts off; 0 = never
  double cutoff_v = 0;          // V, likewise of its weakest cell; 0 = never
  double cutoff_time = 5;       // s
  double low_soc = 0.2;         // charge below which it is told to be low
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

// The states of a humanoid's motion service, by the vendor's ids; -1 or empty if the robot has no
// such state.
struct HumanoidMotionSpec {
  int lock_stand = -1;            // joints locked, standing
  std::vector<int> balance{};     // standing balanced; the first is the default
  int squat = -1;                 // joints locked in squat_q
  int sit = -1;                   // joints locked in sit_q
  int arms_balance = -1;          // told for the first of `balance` while rt/arm_sdk moves the arms
  int protection = -1;            // told in place of damping while protection damps
  int balanced_squat = -1;        // from standing into squat_q and back, balanced
  std::vector<int> unplayed{};    // of the real robot, not simulated
  std::vector<double> squat_q{};  // rad, motor order
  std::vector<double> sit_q{};
  bool stand_heights = true;  // whether a request for a stand height has an effect
  bool arm_actions = false;   // waves, shakes hands ...
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
  // When in a stride FR FL RR RL touch down, 0 to 1: the gait's, no key.
  std::array<double, 4> offsets = {0, 0.5, 0.5, 0};
};

// The parameters of a quadruped's motion service.
struct QuadrupedMotionSpec {
  double stand_height = 0;                      // m, of the base over the ground
  bool stands_up = false;                       // by itself, when its service starts
  bool gestures_from_lock = false;              // and Sit and Pose: balances first
  double foot_x = 0;                            // m, of the feet ahead of the hips
  std::array<double, 2> height_range = {0, 0};  // m about stand_height
  Eigen::Vector3d euler_range{0, 0, 0};         // rad either way: roll, pitch, yaw
  Eigen::Vector3d sit{0, 0, 0};  // m ahead, m over stand_height, rad of pitch: of the base
  double kp = 1;                 // N·m/rad at the legs' joints
  double kd = 0;                 // N·m·s/rad
  double damping_kd = 0;         // N·m·s/rad when damped, at all joints
  double wheel_kp = 0;           // N·m/rad, holds the wheels of a balanced robot
  double wheel_kd = 0;           // N·m·s/rad, brakes them
  WalkSpec walk;
};

// The parameters of the motion service.
struct MotionSpec {
  ProtectionSpec protection;
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
  std::vector<HandSpec> hands;  // hg only, at most kMostHands
  ImuSpec imu;
  EncoderNoiseSpec encoder_noise;
  std::vector<FootSpec> feet;  // FR FL RR RL for quadrupeds: the order of foot_force
  FootSensorSpec foot_sensor;
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
