#include "server/scene_files.h"

#include <algorithm>
#include <charconv>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "mjcf/compile.h"
#include "motion/chord_effects.h"
#include "robot/hand_law.h"
#include "robot/pads.h"
#include "robot/start_pose.h"

namespace understudy::server {
namespace {

using nlohmann::ordered_json;

constexpr char kBytes[] = "application/octet-stream";

// An array of what `tell` makes of each.
template <class Values, class Tell>
ordered_json List(const Values& values, Tell tell) {
  ordered_json list = ordered_json::array();
  for (const auto& value : values) list.push_back(std::invoke(tell, value));
  return list;
}

ordered_json GeomJson(const physics::SceneGeom& geom) {
  return {{"name", geom.name}, {"body", geom.body},    {"type", geom.type},
          {"size", geom.size}, {"pos", geom.pos},      {"quat", geom.quat},
          {"rgba", geom.rgba}, {"group", geom.group},  {"collides", geom.collides},
          {"mesh", geom.mesh}, {"hfield", geom.hfield}};
}

ordered_json MotorJson(const robot::MotorSpec& motor, const physics::Scene& scene,
                       const std::string& prefix) {
  ordered_json told{{"name", motor.joint},
                    {"slot", motor.slot},
                    {"range", nullptr},
                    {"torque_limit", motor.torque_limit},
                    {"knee_speed", motor.knee_speed},
                    {"no_load_speed", motor.no_load_speed}};
  const auto joint =
      std::ranges::find(scene.joints, prefix + motor.joint, &physics::SceneJoint::name);
  if (joint == scene.joints.end()) return told;
  if (joint->limited) told["range"] = joint->range;
  told["qpos"] = joint->position;
  return told;
}

ordered_json ChordJson(const robot::ChordSpec& chord, const robot::RobotSpec& robot) {
  const motion::ChordEffects effects = motion::EffectsOf(robot, chord);
  return {{"keys", chord.keys},
          {"clicks", chord.clicks},
          {"does", chord.does},
          {"value", chord.value},
          {"from", chord.from},
          {"name", effects.name},
          {"simulated", effects.simulated},
          {"effects", List(effects.effects, [](const motion::ChordEffect& effect) -> ordered_json {
             return {{"from", effect.from}, {"to", effect.to}};
           })}};
}

// As in a snapshot: the body's motors, then those of hands, whose slot is their index in motor_cmd.
ordered_json MotorsJson(const robot::RobotSpec& robot, const physics::Scene& scene,
                        const std::string& prefix) {
  ordered_json motors = List(
      robot.motors, [&](const robot::MotorSpec& motor) { return MotorJson(motor, scene, prefix); });
  for (const robot::HandSpec& hand : robot.hands) {
    for (std::size_t i = 0; i < hand.motors.size(); ++i) {
      ordered_json told = MotorJson(hand.motors[i], scene, prefix);
      told["slot"] = i;
      told["hand"] = hand.name;
      motors.push_back(std::move(told));
    }
  }
  return motors;
}

// Of the pads of all hands, in the order of a snapshot's `touch`.
ordered_json PadsJson(const robot::RobotSpec& spec) {
  const std::vector<std::string> names = robot::PadNames(spec);
  ordered_json pads = ordered_json::array();
  for (const robot::HandSpec& hand : spec.hands) {
    for (const robot::PadSpec& pad : hand.pads) {
      pads.push_back({{"hand", robot::HandNameOf(hand, pad.site)},
                      {"name", names[pads.size()]},
                      {"rows", pad.rows},
                      {"columns", pad.columns},
                      {"taxels", pad.taxels}});
    }
  }
  return pads;
}

}  // namespace

HttpReply SceneFiles::Scene() {
  return {.shared = Make("scene", [this] { return SceneText(); })};
}

HttpReply SceneFiles::Mesh(std::string_view index) {
  return Part("mesh", index, reader_->meshes(), &physics::SceneReader::Mesh);
}

HttpReply SceneFiles::HeightField(std::string_view index) {
  return Part("height field", index, reader_->hfields(), &physics::SceneReader::HeightField);
}

HttpReply SceneFiles::Model() {
  return {.type = kBytes,
          .fields = {{"X-Mujoco-Version", mjcf::MujocoVersion()}},
          .shared = Make("model", [this] { return reader_->Model(); })};
}

SceneFiles::Content SceneFiles::Make(const std::string& name,
                                     const std::function<std::string()>& make) {
  std::weak_ptr<const std::string>& made = made_[name];
  Content content = made.lock();
  if (!content) {
    content = std::make_shared<const std::string>(make());
    made = content;
  }
  return content;
}

HttpReply SceneFiles::Part(const std::string& what, std::string_view index, int count,
                           std::string (physics::SceneReader::*make)(int)) {
  int number = -1;
  const auto [end, error] = std::from_chars(index.data(), index.data() + index.size(), number);
  if (error != std::errc{} || end != index.data() + index.size() || number < 0 || number >= count) {
    return ErrorReply(404, "no " + what + " " + std::string{index.substr(0, 32)} +
                               ": the scene has " + std::to_string(count));
  }
  return {.type = kBytes,
          .shared = Make(what + std::to_string(number), [&] { return (reader_->*make)(number); })};
}

std::string SceneFiles::SceneText() {
  const understudy::physics::Scene scene = reader_->Describe();
  const auto base =
      std::ranges::find(scene.bodies, prefix_ + robot_->base_body, &physics::SceneBody::name);
  std::vector<std::string> imus{prefix_ + robot_->imu.site};
  if (!robot_->imu.secondary_site.empty()) {
    imus.push_back(prefix_ + robot_->imu.secondary_site);
  }
  const ordered_json json{
      {"robot", robot_->name},
      {"mujoco", scene.mujoco},
      {"timestep", scene.timestep},
      {"gravity", scene.gravity},
      {"base", base - scene.bodies.begin()},
      {"bodies", List(scene.bodies,
                      [](const physics::SceneBody& body) -> ordered_json {
                        return {{"name", body.name}, {"parent", body.parent}, {"mass", body.mass}};
                      })},
      {"geoms", List(scene.geoms, GeomJson)},
      {"meshes",
       List(scene.meshes,
            [](const physics::SceneMesh& mesh) -> ordered_json {
              return {{"name", mesh.name}, {"vertices", mesh.vertices}, {"faces", mesh.faces}};
            })},
      {"hfields", List(scene.hfields,
                       [](const physics::SceneHeightField& hfield) -> ordered_json {
                         return {{"name", hfield.name},
                                 {"rows", hfield.rows},
                                 {"columns", hfield.columns},
                                 {"size", hfield.size}};
                       })},
      {"cameras", List(scene.cameras,
                       [](const physics::SceneCamera& camera) -> ordered_json {
                         return {{"name", camera.name},
                                 {"body", camera.body},
                                 {"pos", camera.pos},
                                 {"quat", camera.quat},
                                 {"fovy", camera.fovy}};
                       })},
      {"motors", MotorsJson(*robot_, scene, prefix_)},
      {"imus", imus},
      {"feet",
       List(robot_->feet, [](const robot::FootSpec& foot) { return ordered_json(foot.name); })},
      {"pads", PadsJson(*robot_)},
      {"poses", robot::kStartPoses},
      {"states", List(motion::StateNames(*robot_),
                      [](const motion::StateName& state) -> ordered_json {
                        return {{"id", state.id}, {"name", state.name}};
                      })},
      {"chords", List(robot_->remote.chords,
                      [this](const robot::ChordSpec& chord) { return ChordJson(chord, *robot_); })},
  };
  return JsonText(json) + "\n";
}

}  // namespace understudy::server
