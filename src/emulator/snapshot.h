// The state of one instant as plain values, for observers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/settings.h"
#include "physics/world_reading.h"
#include "robot/command_topics.h"
#include "robot/damage.h"
#include "robot/fault.h"
#include "robot/robot_values.h"

namespace understudy::emulator {

// The parts of a snapshot, as bits. Step, time, speed and paused are always filled in.
enum SnapshotPart : std::uint32_t {
  kPartPositions = 1U << 0,
  kPartBodies = 1U << 1,
  kPartContacts = 1U << 2,
  kPartCom = 1U << 3,
  kPartCrane = 1U << 4,
  kPartPushes = 1U << 5,
  kPartMotors = 1U << 6,
  kPartImus = 1U << 7,
  kPartBattery = 1U << 8,
  kPartFeet = 1U << 9,
  kPartRemote = 1U << 10,
  kPartWirelessRemote = 1U << 11,
  kPartCommand = 1U << 12,
  kPartFaults = 1U << 13,
  kPartDamage = 1U << 14,
  kPartMotion = 1U << 15,
  kPartTruth = 1U << 16,
  kPartTouch = 1U << 17,
  kPartSettings = 1U << 18,  // for GET /settings alone
};
using SnapshotParts = std::uint32_t;  // bits of SnapshotPart

struct SnapshotPartName {
  std::string_view name;
  SnapshotPart part;
};
// The words of ?parts= and the keys of the JSON, in its order.
inline constexpr SnapshotPartName kSnapshotParts[] = {
    {"qpos", kPartPositions},  {"bodies", kPartBodies}, {"contacts", kPartContacts},
    {"com", kPartCom},         {"crane", kPartCrane},   {"pushes", kPartPushes},
    {"motors", kPartMotors},   {"imus", kPartImus},     {"battery", kPartBattery},
    {"feet", kPartFeet},       {"remote", kPartRemote}, {"wireless_remote", kPartWirelessRemote},
    {"command", kPartCommand}, {"faults", kPartFaults}, {"damage", kPartDamage},
    {"motion", kPartMotion},   {"truth", kPartTruth},   {"touch", kPartTouch},
};
inline constexpr SnapshotParts kAllSnapshotParts = (kPartTouch << 1) - 1;

struct SnapshotCrane {
  bool attached = false;
  std::array<double, 3> hook{};  // m, world
  std::array<double, 3> top{};   // m, world; undefined while not attached
  double tension = 0;            // N
};

struct SnapshotPush {
  int body = 0;
  std::array<double, 3> at{};     // m, world
  std::array<double, 3> force{};  // N, world
};

// Of the motion service that is on.
struct SnapshotMotion {
  std::array<char, 32> service{};  // its alias; "" if none is on
  int state = 0;                   // the vendor's id
  std::string_view name{};         // of that state, as in robot::MotionState
};

struct SnapshotFault {
  std::size_t component = 0;  // by Snapshot::components
  const robot::FaultKind* kind = nullptr;
  double by = 0;    // of the kind's unit
  double from = 0;  // s, simulated time
};

// *Assumed*, a robot on its side among stones has about 60.
inline constexpr std::size_t kMostSnapshotContacts = 256;

// World::MakeSnapshot gives vectors their final sizes, contacts and pushes their capacity.
struct Snapshot {
  SnapshotParts parts = 0;  // requested, and then filled in
  // Never change:
  std::size_t robot = 0;                    // its number in the world
  std::vector<std::string> body_names;      // by MuJoCo's id
  std::vector<std::string> motor_names;     // in motor order
  std::vector<std::string> command_topics;  // by number; "" where there is none
  std::vector<std::string> components;      // that can have faults
  std::vector<std::vector<const robot::FaultKind*>> component_faults;  // that each can have
  std::vector<robot::MotorLimits> limits;                              // in motor order
  std::vector<robot::DamageLimit> damage_limits;
  double trip_c = 0;                        // °C
  std::vector<schema::Entry> setting_keys;  // that can change
  std::int64_t step = 0;
  double time = 0;   // simulated s
  double speed = 1;  // wanted; 0 = as fast as possible
  bool paused = false;
  std::vector<double> positions;  // MuJoCo's qpos, one step later than the rest
  std::vector<physics::BodyPose> bodies;
  std::vector<physics::ContactReading> contacts;
  std::array<double, 3> com{};  // of the robot
  SnapshotCrane crane;
  std::vector<SnapshotPush> pushes;  // drags too, of all robots
  // In motor order. This and the next four are as last published.
  std::vector<robot::MotorReading> motors;
  std::array<robot::ImuReading, 2> imus;
  std::size_t imu_count = 1;
  robot::BatteryReading battery;
  std::vector<double> feet;  // N
  robot::RemoteReading remote;
  std::array<std::uint8_t, 40> wireless_remote{};
  std::vector<robot::MotorCommand> command;  // followed by the motors
  std::vector<SnapshotFault> faults;         // that there are now
  robot::DamageTotals damage;                // since the start
  SnapshotMotion motion;
  robot::TrueValues truth;       // of the instant of `motors`
  std::vector<float> touch;      // N on each cell, by hand, pad, row and column: the truth
  std::vector<double> settings;  // by setting_keys
  // The least and the most friction that the ground has now; with kPartSettings.
  std::array<double, 2> ground_friction{};
};

}  // namespace understudy::emulator
