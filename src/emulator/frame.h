// What a viewer is shown of one instant, as plain values.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "physics/world_reading.h"
#include "robot/command_topics.h"
#include "robot/robot_values.h"

namespace understudy::emulator {

// What a frame can hold, by bit; step, time, speed and paused are always there.
enum FramePart : std::uint32_t {
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
};
using FrameParts = std::uint32_t;  // bits of FramePart

struct FramePartName {
  std::string_view name;
  FramePart part;
};
// The words of ?parts= and keys of the JSON, in its order.
inline constexpr FramePartName kFrameParts[] = {
    {"qpos", kPartPositions},  {"bodies", kPartBodies}, {"contacts", kPartContacts},
    {"com", kPartCom},         {"crane", kPartCrane},   {"pushes", kPartPushes},
    {"motors", kPartMotors},   {"imus", kPartImus},     {"battery", kPartBattery},
    {"feet", kPartFeet},       {"remote", kPartRemote}, {"wireless_remote", kPartWirelessRemote},
    {"command", kPartCommand},
};
inline constexpr FrameParts kAllFrameParts = (kPartCommand << 1) - 1;

struct FrameCrane {
  bool attached = false;
  std::array<double, 3> hook{};  // m, world
  std::array<double, 3> top{};   // m, world; means nothing while not attached
  double tension = 0;            // N
};

struct FramePush {
  int body = 0;
  std::array<double, 3> at{};     // m, world
  std::array<double, 3> force{};  // N, world
};

// *Assumed*, a robot on its side among stones has about 60.
inline constexpr std::size_t kMostFrameContacts = 256;
inline constexpr std::size_t kMostFramePushes = 24;

// Vectors have their sizes from the start (World::MakeFrame); of contacts and pushes only the
// capacity.
struct Frame {
  FrameParts parts = 0;  // what is wanted, and what of the following is filled in
  // Never change:
  std::vector<std::string> body_names;      // by MuJoCo's id
  std::vector<std::string> motor_names;     // in motor order
  std::vector<std::string> command_topics;  // by number; "" where there is none
  std::int64_t step = 0;
  double time = 0;   // simulated s
  double speed = 1;  // wanted; 0 = as fast as possible
  bool paused = false;
  std::vector<double> positions;  // MuJoCo's qpos, a step on from the rest
  std::vector<physics::BodyPose> bodies;
  std::vector<physics::ContactReading> contacts;
  std::array<double, 3> com{};  // of the robot
  FrameCrane crane;
  std::vector<FramePush> pushes;  // drags too
  // In motor order, as last told on the wire, as are the next four.
  std::vector<robot::MotorReading> motors;
  std::array<robot::ImuReading, 2> imus;
  std::size_t imu_count = 1;
  robot::BatteryReading battery;
  std::vector<double> feet;  // N
  robot::RemoteReading remote;
  std::array<std::uint8_t, 40> wireless_remote{};
  std::vector<robot::MotorCommand> command;  // that the motors follow
};

}  // namespace understudy::emulator
