// Commands and readings of a robot as plain values in SI units. Quaternions are w, x, y, z.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "robot/protection.h"

namespace understudy::robot {

// The vendor's marks for "no position" and "no velocity" (docs/dev/sources.md#motor-law). They omit
// their term of the motor law for any gain.
inline constexpr double kNoPosition = 2.146e9;
inline constexpr double kNoVelocity = 16000.0;

// The space of commands to parallel pairs (ankle, waist): `mode_pr` in hg messages.
enum class JointSpace : std::uint8_t {
  kPitchRoll = 0,  // PR: the serial joints of the MJCF
  kMotors = 1,     // AB: the two motors that drive them
};

// The command to one motor. Joint side, positive along the MJCF axis; of a parallel pair in AB, of
// the motor itself.
struct MotorCommand {
  // false: the motor gives no torque for any other fields; a hand's motor is locked and brakes.
  bool enabled = false;
  double q = 0;            // rad, or kNoPosition
  double dq = 0;           // rad/s, or kNoVelocity
  double tau = 0;          // N·m, feed-forward
  double kp = 0;           // N·m/rad
  double kd = 0;           // N·m·s/rad
  bool watched = false;    // of a hand: locks when commands stop
  bool timed_out = false;  // of a hand: has locked because commands stopped
  // N·m that the motor gives at most, either way, by a limit that its hand's program has set.
  double most = std::numeric_limits<double>::infinity();
  JointSpace space = JointSpace::kPitchRoll;

  friend bool operator==(const MotorCommand&, const MotorCommand&) = default;
};

// What a motor follows that is not enabled: it only brakes.
inline MotorCommand Locked(double lock_kd) {
  return {.enabled = true, .q = kNoPosition, .kd = lock_kd};
}

// Whether it has the motor go to an angle.
inline bool AsksForAngle(const MotorCommand& command) {
  return command.enabled && command.kp > 0 && command.q != kNoPosition;
}

// Whether it gives the motor torque of its own, not only a brake's.
inline bool AsksForTorque(const MotorCommand& command) {
  return AsksForAngle(command) ||
         (command.enabled &&
          (command.tau != 0 || (command.kd > 0 && command.dq != 0 && command.dq != kNoVelocity)));
}

// One command in motor order: to the motors of the body or of one hand as received, to all motors
// as followed.
struct RobotCommand {
  std::vector<MotorCommand> motors;
  double weight = 0;  // of rt/arm_sdk and rt/hand_sdk: as sent
};

// The reading of one motor. Joint side, signs as in MotorCommand.
struct MotorReading {
  bool enabled = false;
  bool timed_out = false;  // of a hand: has locked because commands stopped
  double led_dq = 0;       // rad/s, of a hand that follows goals: as it is led there
  double most = std::numeric_limits<double>::infinity();  // N·m, as MotorCommand has it
  double q = 0;                                           // rad
  double dq = 0;                                          // rad/s
  double tau = 0;              // N·m, of the motor, before joint friction
  double casing_c = 0;         // degrees Celsius
  double winding_c = 0;        // degrees Celsius
  std::uint32_t lost = 0;      // samples in which the motor did not answer
  bool silent = false;         // it does not answer now: all but these three is as it was
  bool warm = false;           // its winding is so hot that it gives less torque
  bool overheated = false;     // its winding is too hot, and it gives no torque
  bool undervoltage = false;   // its bus has too little voltage
  bool encoder_error = false;  // its encoder is known to read nonsense
};

// The reading of an IMU, I, in the world, W. `f` is the specific force: at rest +g along the upward
// axis.
struct ImuReading {
  Eigen::Quaterniond R_WI{1, 0, 0, 0};
  Eigen::Vector3d w_WI_I{0, 0, 0};  // rad/s
  Eigen::Vector3d f_WI_I{0, 0, 0};  // m/s²
  double temperature_c = 0;
};

inline constexpr std::size_t kMostCells = 40;

// m, what SportModeState.range_obstacle has where nothing is; a public capture of a Go2.
inline constexpr double kNoObstacle = 2;

struct BatteryReading {
  double voltage = 0;  // V, sum of the cells
  double current = 0;  // A, negative while the pack gives
  double soc = 1;      // 0..1
  double temperature_c = 25;
  std::array<double, kMostCells> cell_off_v{};  // V, by how much each cell is over their mean
};

// What the mainboard's small controller tells.
struct BoardReading {
  double centre_c = 0;  // °C
  double charger_c = 0;
  std::array<double, 3> fan_rpm{};
  std::uint8_t stalled = 0;  // bits of fans that do not turn
  bool mute = false;         // it does not answer now: the others are as they were
};

// Pose and velocity of the base, B: the truth of the simulation.
struct BaseReading {
  Eigen::Vector3d p_WB{0, 0, 0};    // m
  Eigen::Vector3d v_WB_W{0, 0, 0};  // m/s
};

// Where a quadruped's lidar programs take its base, B, for; O is the frame `odom`.
struct LegOdometry {
  Eigen::Quaterniond R_OB{1, 0, 0, 0};
  Eigen::Vector3d p_OB{0, 0, 0};    // m
  Eigen::Vector3d v_OB_B{0, 0, 0};  // m/s
};

// Of a humanoid's state machine, on all of the vendor's.
inline constexpr int kZeroTorqueId = 0, kDampingId = 1;

// The state of a motion service.
struct MotionState {
  int id = 0;  // the vendor's state-machine id: `error_code` of a Go2, `fsm_id` of a humanoid
  std::string_view name{};  // of the state, in plain words of ours; lives as long as the program
  // Go2 before firmware 1.1.6: SportModeState.mode; humanoids: 0 static, 1 moving, 2 static, but
  // the feet carry nothing.
  int mode = 0;
  int progress = 0;          // 1 while an action with an end is under way
  int arm_action = 0;        // humanoids: the vendor's id of the action under way or held, 0 none
  int arm_told = 0;          // the same, but 99 after a release until the next action
  bool arm_holding = false;  // humanoids: the arms hold a pose until released
  double body_height = 0;    // m, of the base over its feet
  // Whether the service publishes the following, as a quadruped's does; else they are 0, but a
  // humanoid's v_WB_W. World axes. The position starts at 0 with the service and drifts.
  bool estimates = false;
  Eigen::Vector3d v_WB_W{0, 0, 0};                // m/s, of the base
  Eigen::Vector3d p_WB{0, 0, 0};                  // m, of the base
  int gait = 0;                                   // 1 trot, 2 run, 3 for stairs
  double wanted_height = 0;                       // m, as body_height is to be
  double foot_raise = 0;                          // m that its gait lifts a foot by
  bool keeps_stepping = false;                    // on the spot where it would stand
  bool avoids = false;                            // what it is asked to do avoids obstacles
  std::array<Eigen::Vector3d, 4> feet{};          // m, in the base, FR FL RR RL
  std::array<Eigen::Vector3d, 4> feet_speed{};    // m/s, against the base and in it
  std::array<DangerReading, kDangers> dangers{};  // by Danger
};

// The state of the remote controller. Sticks -1..1: right, forward and clockwise are positive.
struct RemoteReading {
  bool there = false;      // false: nothing is received, and the rest is 0
  std::uint16_t keys = 0;  // bits of pressed keys (robot/remote_keys.h)
  double lx = 0, ly = 0;   // left stick
  double rx = 0, ry = 0;   // right stick
};

// What sensors measure, as it is: without noise, lattice and faults.
struct TrueValues {
  std::vector<double> q;    // rad, motor order, as the next two
  std::vector<double> dq;   // rad/s
  std::vector<double> tau;  // N·m, of the motor, before joint friction
  ImuReading imu;           // without its temperature, as the next one
  ImuReading secondary_imu;
  std::vector<double> foot_force;  // N, in RobotSpec::feet order
};

// All readings of one instant. Default values before the first sample.
struct RobotState {
  std::int64_t tick_ms = 0;                         // simulated milliseconds since start
  std::vector<MotorReading> motors;                 // motor order
  JointSpace joint_space = JointSpace::kPitchRoll;  // AB if a motor is commanded in it
  ImuReading imu;                                   // of LowState
  ImuReading secondary_imu;                         // if the robot has one
  std::vector<double> foot_force;                   // N, as read, in RobotSpec::feet order
  // Counts of all cells of all pads, by hand, pad and row; as old as the last message with them.
  std::vector<float> touch;
  BatteryReading battery;
  BoardReading board;
  BaseReading base;
  BaseReading odometry;  // what the robot's own programs take that for, where no service estimates
  std::optional<LegOdometry> leg_odometry;  // nullopt while no motion service estimates
  TrueValues truth;
  RemoteReading remote;
  std::optional<MotionState> motion;  // nullopt while no motion service is on
  // m to what its lidar sees ahead, to the right, behind and to the left; kNoObstacle where
  // nothing.
  std::array<double, 4> obstacle_ranges{kNoObstacle, kNoObstacle, kNoObstacle, kNoObstacle};
};

}  // namespace understudy::robot
