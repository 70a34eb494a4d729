#include "commands/mjlab_package.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <mujoco/mujoco.h>
#include <nlohmann/json.hpp>

#include "assembly/make_world.h"
#include "base/errors.h"
#include "base/files.h"
#include "config/data_dir.h"
#include "config/randomization_keys.h"
#include "mjcf/eigen_views.h"
#include "mjcf/saved_model.h"
#include "physics/feet.h"
#include "physics/geom_extent.h"
#include "physics/world_model.h"
#include "policy/interpreter.h"
#include "robot/motor.h"
#include "run/log_notes.h"
#include "version.h"

namespace understudy::commands {
namespace {

// The draws that config/export/mjlab/task.py plays.
constexpr std::array<std::string_view, 10> kPlayedByMjlab{
    "friction",     "mass", "base_com", "motor_strength", "damping", "armature",
    "frictionloss", "kp",   "kd",       "delay"};

std::string NameOf(const mjModel& model, int type, int id) {
  const char* const name = mj_id2name(&model, type, id);
  return name == nullptr ? "" : name;
}

constexpr char kFigures[] = "figures.json";

bool IsPackageName(const std::string& name) {
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  return !name.empty() && is_letter(name[0]) &&
         std::ranges::all_of(name, [&](char c) { return is_letter(c) || (c >= '0' && c <= '9'); });
}

// Nothing of somebody else's is replaced.
void CheckIsOurs(const std::filesystem::path& folder) {
  std::error_code ignored;
  if (!std::filesystem::exists(folder, ignored) || std::filesystem::is_empty(folder, ignored) ||
      std::filesystem::exists(folder / kFigures, ignored)) {
    return;
  }
  throw RecordError("--out " + folder.string() +
                    ": expected a new folder, or one that export mjlab has written");
}

void CheckWalks(const robot::RobotSpec& spec) {
  const bool walks =
      spec.kind == robot::RobotKind::kQuadruped || spec.kind == robot::RobotKind::kHumanoid;
  if (!walks || spec.feet.empty() || spec.standing.q.size() != spec.motors.size()) {
    throw ConfigError(spec.name +
                      ": expected a robot.kind of quadruped or humanoid, robot.feet and "
                      "robot.standing: mjlab's task is to walk");
  }
}

nlohmann::json MotorFigures(const robot::RobotSpec& spec) {
  const std::vector<double> shares = robot::KdShares(spec);
  nlohmann::json motors = nlohmann::json::array();
  for (std::size_t i = 0; i < spec.motors.size(); ++i) {
    const robot::MotorSpec& motor = spec.motors[i];
    motors.push_back({{"joint", motor.joint},
                      {"slot", motor.slot},
                      {"type", motor.type},
                      {"torque_limit", motor.torque_limit * motor.strength},
                      {"knee_speed", motor.knee_speed},
                      {"no_load_speed", motor.no_load_speed},
                      {"kp_share", motor.kp_scale * motor.strength},
                      {"kd_share", shares[i] * motor.kd_scale * motor.strength}});
  }
  return motors;
}

// Where a foot is: the middle of its geoms, in their body.
nlohmann::json FootFigures(const mjModel& model, const robot::RobotSpec& spec) {
  const mjcf::DataHandle data(mj_makeData(&model));
  mj_kinematics(&model, data.get());
  const std::vector<std::vector<int>> geoms = physics::FootGeoms(model, *data, spec);
  nlohmann::json feet = nlohmann::json::array();
  for (std::size_t i = 0; i < spec.feet.size(); ++i) {
    if (geoms[i].empty()) throw ModelError("robot.feet: " + spec.feet[i].name + " has no geom");
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const int geom : geoms[i]) middle += mjcf::Vector(model.geom_pos + 3 * geom);
    middle /= static_cast<double>(geoms[i].size());
    feet.push_back({{"name", "foot_" + spec.feet[i].name},
                    {"body", NameOf(model, mjOBJ_BODY, model.geom_bodyid[geoms[i][0]])},
                    {"pos", {middle.x(), middle.y(), middle.z()}}});
  }
  return feet;
}

double GroundFriction(const mjModel& model) {
  double most = 0;
  for (int geom = 0; geom < model.ngeom; ++geom) {
    if (model.geom_bodyid[geom] == 0 && physics::Collides(model, geom)) {
      most = std::max(most, model.geom_friction[3 * static_cast<std::ptrdiff_t>(geom)]);
    }
  }
  return most;
}

nlohmann::json NoiseFigures(const config::RobotConfig& robot) {
  const robot::RobotSpec& spec = robot.spec;
  const double gain = robot.sensors.noise ? robot.sensors.noise_gain : 0;
  const robot::MotorSpec& motor = spec.motors[0];
  return {{"gyroscope", gain * spec.imu.gyro_noise},
          {"q", gain * spec.encoder_noise.q_steps * motor.q_step},
          {"dq", gain * spec.encoder_noise.dq_steps * motor.dq_step}};
}

// s from a command to its torque, with what is drawn.
nlohmann::json DelayFigures(const robot::RobotSpec& spec, const robot::RandomizationSpec& drawn) {
  std::array<double, 2> delay{spec.dynamics.delay, spec.dynamics.delay};
  for (std::size_t end = 0; end < 2; ++end) {
    double bus = 0;
    for (const robot::BusSpec& one : spec.buses) bus = std::max(bus, one.delay[end]);
    delay[end] += bus + (drawn.delay.empty() ? 0 : drawn.delay[end]);
  }
  return delay;
}

nlohmann::json Figures(const config::RobotConfig& robot, const robot::RandomizationSpec& drawn,
                       const mjModel& model) {
  const robot::RobotSpec& spec = robot.spec;
  nlohmann::json joints, ranges = nlohmann::json::object();
  for (std::size_t i = 0; i < spec.motors.size(); ++i) {
    joints[spec.motors[i].joint] = spec.standing.q[i];
  }
  for (const config::RandomRange& range : config::RandomRanges()) {
    const auto& limits = drawn.*range.limits;
    if (!limits.empty()) ranges[std::string(range.name)] = limits;
  }
  return {{"understudy", kVersion},
          {"robot", spec.name},
          {"base", spec.base_body},
          {"imu", spec.imu.site},
          {"ground_friction", GroundFriction(model)},
          {"standing", {{"height", spec.standing.height}, {"joints", joints}}},
          {"feet", FootFigures(model, spec)},
          {"motors", MotorFigures(spec)},
          {"delay", DelayFigures(spec, drawn)},
          {"noise", NoiseFigures(robot)},
          {"randomization", ranges}};
}

// A definition of the robot's own pose and of the gains that hold it; scales and ranges are
// *assumed*, those of the tasks of the Python package.
std::string OwnDefinition(const robot::RobotSpec& spec) {
  std::vector<int> slots;
  const auto count = static_cast<std::size_t>(spec.motors.back().slot) + 1;
  std::vector<double> kp(count), kd(count);  // by slot
  for (const robot::MotorSpec& motor : spec.motors) {
    slots.push_back(motor.slot);
    kp[static_cast<std::size_t>(motor.slot)] = motor.hold_kp;
    kd[static_cast<std::size_t>(motor.slot)] = motor.hold_kd;
  }
  const std::string pose = fmt::format("{}", spec.standing.q);
  return fmt::format(
      "joint_ids_map: {}\nstep_dt: 0.02\nstiffness: {}\ndamping: {}\ndefault_joint_pos: {}\n"
      "commands:\n  base_velocity:\n"
      "    ranges: {{lin_vel_x: [-0.5, 1], lin_vel_y: [-0.3, 0.3], ang_vel_z: [-0.8, 0.8]}}\n"
      "actions:\n  JointPositionAction:\n    scale: 0.25\n    offset: {}\n"
      "observations:\n"
      "  base_ang_vel: {{params: {{}}, clip: [-100, 100], scale: 0.2}}\n"
      "  projected_gravity: {{params: {{}}, clip: [-100, 100]}}\n"
      "  velocity_commands: {{params: {{command_name: base_velocity}}, clip: [-100, 100]}}\n"
      "  joint_pos_rel: {{params: {{}}, clip: [-100, 100]}}\n"
      "  joint_vel_rel: {{params: {{}}, clip: [-100, 100], scale: 0.05}}\n"
      "  last_action: {{params: {{}}, clip: [-100, 100]}}\n",
      slots, kp, kd, pose, pose);
}

std::string DefinitionFor(const robot::RobotSpec& spec, const std::filesystem::path& file) {
  std::string text = file.empty() ? OwnDefinition(spec) : FileText(file);
  std::vector<policy::MotorName> motors;
  for (const robot::MotorSpec& motor : spec.motors) motors.push_back({motor.joint, motor.slot});
  const policy::Interpreter fits(  // or throws
      file.empty() ? policy::ParseDefinition(text, "deploy.yaml") : policy::ReadDefinition(file),
      motors, spec.name);
  return text;
}

}  // namespace

std::vector<std::string> WriteMjlabPackage(config::Config config,
                                           const std::filesystem::path& folder,
                                           const std::filesystem::path& definition) {
  const std::filesystem::path path = std::filesystem::absolute(folder / "").parent_path();
  if (!IsPackageName(path.filename().string())) {
    throw ConfigError("--out " + folder.string() +
                      ": expected the name of a Python package, such as my_robot");
  }
  CheckIsOurs(path);
  CheckWalks(config.robots[0].spec);
  // mjlab draws anew for each of its worlds: the model has none of it.
  const robot::RandomizationSpec drawn = std::exchange(config.randomization, {});
  const assembly::MadePhysics made = assembly::MakePhysics(&config);
  run::LogNotes(made.notes);
  const config::RobotConfig& robot = config.robots[0];
  const mjModel& model = made.world.robot().model();
  const std::string deploy = DefinitionFor(robot.spec, definition);
  MakeFolder(path);
  WriteFile(path / "robot.xml", mjcf::SaveModel(model, physics::kClampName).xml);
  WriteFile(path / kFigures, Figures(robot, drawn, model).dump(1) + "\n");
  WriteFile(path / "deploy.yaml", deploy);
  for (const char* const file : {"__init__.py", "task.py", "__main__.py"}) {
    WriteFile(path / file, FileText(config::DataDir() / "config/export/mjlab" / file));
  }
  std::vector<std::string> left_out;
  for (const config::RandomRange& range : config::RandomRanges()) {
    if (!(drawn.*range.limits).empty() && std::ranges::count(kPlayedByMjlab, range.name) == 0) {
      left_out.emplace_back(range.name);
    }
  }
  return left_out;
}

}  // namespace understudy::commands
