// The simulation's truth as ROS 2 and Foxglove have it, for their tools and viewers: messages of
// ROS's own types (of ROS 2 Humble and later), which a recording has beside the robot's.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mjcf/robot_tree.h"
#include "mjcf/scene_shapes.h"
#include "record/bytes.h"
#include "record/truth.h"

namespace understudy::record {

// The frame of what the simulation knows: no estimate of a robot's has this name (those are "odom"
// and "map").
inline constexpr char kWorldFrame[] = "world";

// A topic, and whether late readers get its last message (transient local).
struct RosTopic {
  const char* name;
  const char* type;
  bool latched;
};

extern const RosTopic kTfTopic;                // links that move, in the link before
extern const RosTopic kTfStaticTopic;          // those that do not
extern const RosTopic kJointStatesTopic;       // of all joints but fixed ones
extern const RosTopic kRobotDescriptionTopic;  // URDF
extern const RosTopic kClockTopic;
extern const RosTopic kSceneTopic;

// Returns the schema of a topic's type as ros2msg, with those of its parts.
std::string RosSchema(const RosTopic& topic);

// Of what the messages are made.
struct RosRobot {
  mjcf::RobotTree tree;
  std::vector<int> motors{};  // by joint of the tree: index in motor order; -1: it has none
  std::string urdf{};
  std::vector<mjcf::SceneShape> scene{};
  // From one /tf, /joint_states and /clock to the next, in steps of the physics; a multiple of
  // those from one truth to the next. At least 1.
  std::int64_t every = 1;
};

// Encode to little-endian XCDR1, overwriting `out`; `time` is ns since 1970. Links whose places in
// qpos are beyond that of `truth` stand as at 0; joints have no effort without a motor.
void EncodeTf(const RosRobot& robot, const Truth& truth, std::uint64_t time, BytesOut* out);
void EncodeTfStatic(const RosRobot& robot, std::uint64_t time, BytesOut* out);
void EncodeJointStates(const RosRobot& robot, const Truth& truth, std::uint64_t time,
                       BytesOut* out);
void EncodeRobotDescription(const RosRobot& robot, BytesOut* out);
void EncodeClock(std::uint64_t time, BytesOut* out);
// A marker for each shape, fixed in kWorldFrame, with the geom's name as namespace.
void EncodeScene(const RosRobot& robot, std::uint64_t time, BytesOut* out);

}  // namespace understudy::record
