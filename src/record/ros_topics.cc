#include "record/ros_topics.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <sstream>
#include <string_view>

#include "record/cdr_out.h"

namespace understudy::record {

constexpr RosTopic kTfTopic = {"/tf", "tf2_msgs/msg/TFMessage", false};
constexpr RosTopic kTfStaticTopic = {"/tf_static", "tf2_msgs/msg/TFMessage", true};
constexpr RosTopic kJointStatesTopic = {"/joint_states", "sensor_msgs/msg/JointState", false};
constexpr RosTopic kRobotDescriptionTopic = {"/robot_description", "std_msgs/msg/String", true};
constexpr RosTopic kClockTopic = {"/clock", "rosgraph_msgs/msg/Clock", false};
constexpr RosTopic kSceneTopic = {"/scene", "visualization_msgs/msg/MarkerArray", true};

namespace {

using Eigen::Isometry3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using mjcf::SceneShape;
using mjcf::TreeJoint;

// ROS's definitions of messages, of constants those that are used.
struct RosMessage {
  std::string_view name;
  std::string_view fields;
};
constexpr RosMessage kRosDefinitions[] = {
    {"builtin_interfaces/Duration", "int32 sec\nuint32 nanosec\n"},
    {"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"},
    {"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/Pose",
     "geometry_msgs/Point position\n"
     "geometry_msgs/Quaternion orientation\n"},
    {"geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"},
    {"geometry_msgs/Transform",
     "geometry_msgs/Vector3 translation\n"
     "geometry_msgs/Quaternion rotation\n"},
    {"geometry_msgs/TransformStamped",
     "std_msgs/Header header\n"
     "string child_frame_id\n"
     "geometry_msgs/Transform transform\n"},
    {"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"rosgraph_msgs/Clock", "builtin_interfaces/Time clock\n"},
    {"sensor_msgs/CompressedImage",
     "std_msgs/Header header\n"
     "string format\n"
     "uint8[] data\n"},
    {"sensor_msgs/JointState",
     "std_msgs/Header header\n"
     "string[] name\n"
     "float64[] position\n"
     "float64[] velocity\n"
     "float64[] effort\n"},
    {"std_msgs/ColorRGBA", "float32 r\nfloat32 g\nfloat32 b\nfloat32 a\n"},
    {"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"},
    {"std_msgs/String", "string data\n"},
    {"tf2_msgs/TFMessage", "geometry_msgs/TransformStamped[] transforms\n"},
    {"visualization_msgs/Marker",
     "int32 CUBE=1\n"
     "int32 SPHERE=2\n"
     "int32 CYLINDER=3\n"
     "int32 TRIANGLE_LIST=11\n"
     "int32 ADD=0\n"
     "std_msgs/Header header\n"
     "string ns\n"
     "int32 id\n"
     "int32 type\n"
     "int32 action\n"
     "geometry_msgs/Pose pose\n"
     "geometry_msgs/Vector3 scale\n"
     "std_msgs/ColorRGBA color\n"
     "builtin_interfaces/Duration lifetime\n"
     "bool frame_locked\n"
     "geometry_msgs/Point[] points\n"
     "std_msgs/ColorRGBA[] colors\n"
     "string texture_resource\n"
     "sensor_msgs/CompressedImage texture\n"
     "visualization_msgs/UVCoordinate[] uv_coordinates\n"
     "string text\n"
     "string mesh_resource\n"
     "visualization_msgs/MeshFile mesh_file\n"
     "bool mesh_use_embedded_materials\n"},
    {"visualization_msgs/MarkerArray", "visualization_msgs/Marker[] markers\n"},
    {"visualization_msgs/MeshFile", "string filename\nuint8[] data\n"},
    {"visualization_msgs/UVCoordinate", "float32 u\nfloat32 v\n"},
};

// The definition of "std_msgs/Header"; null for what has none, such as "float64".
const RosMessage* DefinitionOf(std::string_view name) {
  const auto found = std::ranges::find(kRosDefinitions, name, &RosMessage::name);
  return found == std::end(kRosDefinitions) ? nullptr : found;
}

void PutTime(std::uint64_t time, BytesOut* out) {
  constexpr std::uint64_t kSecond = 1'000'000'000;
  PutNumber(static_cast<std::int32_t>(time / kSecond), out);
  PutNumber(static_cast<std::uint32_t>(time % kSecond), out);
}

void PutHeader(std::uint64_t time, std::string_view frame, BytesOut* out) {
  PutTime(time, out);
  PutText(frame, out);
}

void PutVector(const Vector3d& vector, BytesOut* out) {
  for (const double number : vector) PutNumber(number, out);
}

// Position, and the rotation as x, y, z, w: ROS's order, and that of Eigen's coefficients.
void PutPose(const Isometry3d& pose, BytesOut* out) {
  PutVector(pose.translation(), out);
  const Quaterniond rotation(pose.linear());
  for (const double number : rotation.coeffs()) PutNumber(number, out);
}

void PutTransform(std::uint64_t time, const std::string& parent, const std::string& child,
                  const Isometry3d& pose, BytesOut* out) {
  PutHeader(time, parent, out);
  PutText(child, out);
  PutPose(pose, out);
}

double At(const std::vector<double>& numbers, int index) {
  return index >= 0 && static_cast<std::size_t>(index) < numbers.size()
             ? numbers[static_cast<std::size_t>(index)]
             : 0;
}

bool Moves(const TreeJoint& joint) { return joint.kind != TreeJoint::Kind::kFixed; }

Isometry3d PoseOfBase(const mjcf::RobotTree& tree, const Truth& truth) {
  const int at = tree.base_qpos;
  const std::vector<double>& q = truth.qpos;
  return Eigen::Translation3d(At(q, at), At(q, at + 1), At(q, at + 2)) *
         Quaterniond(At(q, at + 3), At(q, at + 4), At(q, at + 5), At(q, at + 6)).normalized();
}

template <typename Is>
std::size_t CountIf(const std::vector<TreeJoint>& joints, Is is) {
  return static_cast<std::size_t>(std::ranges::count_if(joints, is));
}

void PutMarker(const SceneShape& shape, int id, std::uint64_t time, BytesOut* out) {
  constexpr std::int32_t kCube = 1, kSphere = 2, kCylinder = 3, kTriangles = 11, kAdd = 0;
  const auto type = [&] {
    switch (shape.kind) {
      case SceneShape::Kind::kBox:
        return kCube;
      case SceneShape::Kind::kEllipsoid:
        return kSphere;
      case SceneShape::Kind::kCylinder:
        return kCylinder;
      case SceneShape::Kind::kTriangles:
        break;
    }
    return kTriangles;
  };
  PutHeader(time, kWorldFrame, out);
  PutText(shape.name, out);
  PutNumber(std::int32_t{id}, out);
  PutNumber(type(), out);
  PutNumber(kAdd, out);
  PutPose(shape.X_WS, out);
  PutVector(shape.size, out);
  for (const float part : shape.rgba) PutNumber(part, out);
  PutNumber(std::int32_t{0}, out);  // lifetime: for ever
  PutNumber(std::uint32_t{0}, out);
  PutNumber(std::uint8_t{0}, out);  // frame_locked: the world does not move
  PutCount(shape.corners.size(), out);
  for (const Vector3d& corner : shape.corners) PutVector(corner, out);
  PutCount(0, out);                 // colors
  PutText("", out);                 // texture_resource
  PutHeader(0, "", out);            // texture
  PutText("", out);                 // its format
  PutCount(0, out);                 // its data
  PutCount(0, out);                 // uv_coordinates
  PutText("", out);                 // text
  PutText("", out);                 // mesh_resource
  PutText("", out);                 // mesh_file: its name
  PutCount(0, out);                 // its data
  PutNumber(std::uint8_t{0}, out);  // mesh_use_embedded_materials
}

}  // namespace

std::string RosSchema(const RosTopic& topic) {
  std::string root = topic.type;
  root.erase(root.find("/msg/"), 4);
  std::vector<const RosMessage*> parts = {DefinitionOf(root)};
  std::string text(parts.front()->fields);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    std::istringstream lines{std::string(parts[i]->fields)};
    for (std::string line; std::getline(lines, line);) {
      const RosMessage* const part = DefinitionOf(line.substr(0, line.find_first_of(" [")));
      if (part == nullptr || std::ranges::find(parts, part) != parts.end()) continue;
      parts.push_back(part);
      text.append(80, '=').append("\nMSG: ").append(part->name).append("\n").append(part->fields);
    }
  }
  return text;
}

void EncodeTf(const RosRobot& robot, const Truth& truth, std::uint64_t time, BytesOut* out) {
  const mjcf::RobotTree& tree = robot.tree;
  const bool free = tree.base_qpos >= 0;
  PutCdrHead(out);
  PutCount(CountIf(tree.joints, Moves) + (free ? 1 : 0), out);
  if (free) PutTransform(time, kWorldFrame, tree.base, PoseOfBase(tree, truth), out);
  for (const TreeJoint& joint : tree.joints) {
    if (!Moves(joint)) continue;
    PutTransform(time, joint.parent, joint.child, joint.At(At(truth.qpos, joint.qpos)), out);
  }
}

void EncodeTfStatic(const RosRobot& robot, std::uint64_t time, BytesOut* out) {
  const mjcf::RobotTree& tree = robot.tree;
  const bool fixed = tree.base_qpos < 0;
  PutCdrHead(out);
  PutCount(CountIf(tree.joints, std::not_fn(Moves)) + (fixed ? 1 : 0), out);
  if (fixed) PutTransform(time, kWorldFrame, tree.base, tree.X_WB, out);
  for (const TreeJoint& joint : tree.joints) {
    if (!Moves(joint)) PutTransform(time, joint.parent, joint.child, joint.X_PC, out);
  }
}

void EncodeJointStates(const RosRobot& robot, const Truth& truth, std::uint64_t time,
                       BytesOut* out) {
  const std::vector<TreeJoint>& joints = robot.tree.joints;
  const std::size_t count = CountIf(joints, Moves);
  const auto put = [&](auto value_of) {
    PutCount(count, out);
    for (std::size_t i = 0; i < joints.size(); ++i) {
      if (Moves(joints[i])) PutNumber(value_of(i), out);
    }
  };
  PutCdrHead(out);
  PutHeader(time, "", out);
  PutCount(count, out);
  for (const TreeJoint& joint : joints) {
    if (Moves(joint)) PutText(joint.name, out);
  }
  put([&](std::size_t i) { return At(truth.qpos, joints[i].qpos); });
  put([&](std::size_t i) { return At(truth.qvel, joints[i].dof); });
  put([&](std::size_t i) { return At(truth.tau, robot.motors[i]); });
}

void EncodeRobotDescription(const RosRobot& robot, BytesOut* out) {
  PutCdrHead(out);
  PutText(robot.urdf, out);
}

void EncodeClock(std::uint64_t time, BytesOut* out) {
  PutCdrHead(out);
  PutTime(time, out);
}

void EncodeScene(const RosRobot& robot, std::uint64_t time, BytesOut* out) {
  PutCdrHead(out);
  PutCount(robot.scene.size(), out);
  int id = 0;
  for (const SceneShape& shape : robot.scene) PutMarker(shape, id++, time, out);
}

}  // namespace understudy::record
