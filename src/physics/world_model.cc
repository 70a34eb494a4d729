#include "physics/world_model.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <mutex>
#include <utility>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "mjcf/assets.h"
#include "mjcf/compile.h"
#include "mjcf/fit_names.h"
#include "mjcf/looks.h"
#include "mjcf/revise.h"
#include "physics/feet.h"
#include "physics/geom_extent.h"
#include "physics/joint_dynamics.h"

namespace understudy::physics {
namespace {

// MuJoCo's hooks are plain C globals, so what they note is one too.
std::mutex warning_mutex;
std::array<char, 512> last_warning{};

// mju_error must not return. Throwing is safe here: MuJoCo's C code holds nothing but its own arena
// at these points, and the model it was working on is abandoned.
void OnMujocoError(const char* message) { throw ModelError(std::string("MuJoCo: ") + message); }

void OnMujocoWarning(const char* message) {
  const std::lock_guard lock(warning_mutex);
  std::strncpy(last_warning.data(), message, last_warning.size() - 1);
}

mjcf::MjcfElement Element(const std::string& name,
                          std::vector<std::pair<std::string, std::string>> attributes) {
  return {.name = name, .attributes = std::move(attributes), .children = {}, .place = {}};
}

void AddImuSensors(const std::string& site, const char* gyro, const char* accel,
                   mjcf::MjcfElement* section) {
  if (site.empty()) return;
  section->children.push_back(Element("gyro", {{"name", gyro}, {"site", site}}));
  section->children.push_back(Element("accelerometer", {{"name", accel}, {"site", site}}));
}

// What the emulator needs of the robot beyond its file.
void AddOurs(const robot::RobotSpec& spec, bool has_free_base, mjcf::MjcfElement* root) {
  if (has_free_base) {
    // Stiffness of the clamp, a time constant of 4 ms without overshoot: assumed.
    mjcf::MjcfElement equality = Element("equality", {});
    equality.children.push_back(Element("weld", {{"name", kClampName},
                                                 {"body1", spec.base_body},
                                                 {"active", "false"},
                                                 {"solref", "0.004 1"}}));
    root->children.push_back(std::move(equality));
  }
  mjcf::MjcfElement sensor = Element("sensor", {});
  AddImuSensors(spec.imu.site, kImuGyroName, kImuAccelName, &sensor);
  AddImuSensors(spec.imu.secondary_site, kSecondaryGyroName, kSecondaryAccelName, &sensor);
  root->children.push_back(std::move(sensor));
}

// Room for contacts. MuJoCo 2 makes it once, before it knows what will touch; MuJoCo 3 when it is
// needed. The most seen is a G1 that struggles on rough ground: 68 contacts, 302 rows.
void MakeRoom(const mjModel& robot, mjcf::MjcfElement* root) {
#if mjVERSION_HEADER < 300
  constexpr int kContacts = 300, kRows = 1200;
  root->children.push_back(
      Element("size", {{"nconmax", std::to_string(std::max(robot.nconmax, kContacts))},
                       {"njmax", std::to_string(std::max(robot.njmax, kRows))}}));
#else
  (void)robot;
  (void)root;
#endif
}

bool HasGround(const mjModel& model) {
  for (int i = 0; i < model.ngeom; ++i) {
    const int type = model.geom_type[i];
    const bool ground = type == mjGEOM_PLANE || type == mjGEOM_HFIELD;
    if (model.geom_bodyid[i] == 0 && ground && Collides(model, i)) return true;
  }
  return false;
}

bool HasFreeBase(const mjModel& model, int base) {
  return model.body_jntnum[base] == 1 && model.jnt_type[model.body_jntadr[base]] == mjJNT_FREE;
}

// Checks that the model has what the description names.
class NameCheck {
 public:
  NameCheck(const mjModel& model, const std::filesystem::path& file)
      : model_(model), file_(file.string()) {}

  bool Has(mjtObj type, const std::string& name) const {
    return mj_name2id(&model_, type, name.c_str()) >= 0;
  }

  // `what` is for people, `key` where the description names it.
  void Require(mjtObj type, const std::string& what, const std::string& name,
               const std::string& key) const {
    if (Has(type, name)) return;
    const std::string nearest = NearestWord(name, Names(type));
    throw ModelError(file_ + ": no " + what + " '" + name + "'" +
                     (nearest.empty() ? "" : "; did you mean '" + nearest + "'?") + " (" + key +
                     " names it)");
  }

  [[noreturn]] void Refuse(const std::string& what) const { throw ModelError(file_ + ": " + what); }

 private:
  std::vector<std::string> Names(mjtObj type) const {
    auto count = model_.ngeom;
    if (type == mjOBJ_BODY) count = model_.nbody;
    if (type == mjOBJ_JOINT) count = model_.njnt;
    if (type == mjOBJ_SITE) count = model_.nsite;
    std::vector<std::string> names;
    for (int i = 0; i < static_cast<int>(count); ++i) {
      if (const char* text = mj_id2name(&model_, type, i); text != nullptr && *text != '\0') {
        names.emplace_back(text);
      }
    }
    return names;
  }

  const mjModel& model_;
  std::string file_;
};

void RequireBase(const mjModel& model, const robot::RobotSpec& spec, const NameCheck& check) {
  check.Require(mjOBJ_BODY, "base body", spec.base_body, "robot.base_body");
  const int base = mj_name2id(&model, mjOBJ_BODY, spec.base_body.c_str());
  if (HasFreeBase(model, base) || model.body_weldid[base] == 0) return;
  check.Refuse("base body '" + spec.base_body +
               "' is neither free nor fixed to the world: add <freejoint/> to it, or let "
               "robot.base_body name another body");
}

// `list`: the key of the motors.
void RequireMotors(const mjModel& model, const std::vector<robot::MotorSpec>& motors,
                   const std::string& list, const NameCheck& check) {
  for (std::size_t i = 0; i < motors.size(); ++i) {
    const std::string& name = motors[i].joint;
    check.Require(mjOBJ_JOINT, "joint", name, list + "." + std::to_string(i) + ".joint");
    const int type = model.jnt_type[mj_name2id(&model, mjOBJ_JOINT, name.c_str())];
    if (type != mjJNT_HINGE && type != mjJNT_SLIDE) {
      check.Refuse("joint '" + name + "' of a motor must be a hinge or a slide");
    }
  }
}

void RequireFeet(const robot::RobotSpec& spec, const NameCheck& check) {
  for (std::size_t i = 0; i < spec.feet.size(); ++i) {
    for (const std::string& geom : spec.feet[i].geoms) {
      check.Require(mjOBJ_GEOM, "geom of foot " + spec.feet[i].name, geom,
                    "robot.feet." + std::to_string(i) + ".geoms");
    }
  }
}

void RequireWhatSpecNames(const mjModel& model, const robot::RobotSpec& spec,
                          const NameCheck& check) {
  RequireBase(model, spec, check);
  RequireMotors(model, spec.motors, "robot.motors", check);
  for (std::size_t i = 0; i < spec.hands.size(); ++i) {
    RequireMotors(model, spec.hands[i].motors, "robot.hands." + std::to_string(i) + ".motors",
                  check);
  }
  check.Require(mjOBJ_SITE, "IMU site", spec.imu.site, "robot.imu.site");
  if (!spec.imu.secondary_site.empty()) {
    check.Require(mjOBJ_SITE, "IMU site", spec.imu.secondary_site, "robot.imu.secondary_site");
  }
  check.Require(mjOBJ_BODY, "crane body", spec.crane_body, "robot.crane_body");
}

// Says of each foot of another hand's model what stands for it.
void NoteFeet(const mjModel& model, const robot::RobotSpec& spec, LoadNotes* notes) {
  const mjcf::DataHandle data(mj_makeData(&model));
  mj_kinematics(&model, data.get());
  const std::vector<int> foot_of_geom = FindFeet(model, *data, spec);
  for (std::size_t foot = 0; foot < spec.feet.size(); ++foot) {
    const std::vector<std::string>& names = spec.feet[foot].geoms;
    if (std::ranges::all_of(names, [&](const std::string& name) {
          return mj_name2id(&model, mjOBJ_GEOM, name.c_str()) >= 0;
        })) {
      continue;
    }
    int count = 0;
    std::string body;
    for (int geom = 0; geom < static_cast<int>(model.ngeom); ++geom) {
      if (foot_of_geom[static_cast<std::size_t>(geom)] != static_cast<int>(foot)) continue;
      ++count;
      const char* name = mj_id2name(&model, mjOBJ_BODY, model.geom_bodyid[geom]);
      body = name == nullptr ? "" : name;
    }
    const std::string& name = spec.feet[foot].name;
    notes->warnings.push_back(
        count == 0 ? "foot " + name +
                         ": the model has none of its geoms, so it feels no force; "
                         "name them in robot.feet." +
                         std::to_string(foot) + ".geoms"
                   : "foot " + name + ": " + std::to_string(count) + " geom" +
                         (count == 1 ? "" : "s") + " of body '" + body + "', the lowest there");
  }
}

// Whether what is only looked at is compiled too.
enum class Looks { kLeftOut, kKept };

mjcf::MjcfElement Read(const std::filesystem::path& file, [[maybe_unused]] Looks kept,
                       LoadNotes* notes) {
  LoadNotes unread;
  if (notes == nullptr) notes = &unread;
  mjcf::MjcfElement root = mjcf::ReadMjcf(file);
#if mjVERSION_HEADER < 300
  // MuJoCo 2.2.2 also takes its time over what nobody sees.
  const mjcf::LeftOutLooks looks =
      kept == Looks::kLeftOut ? mjcf::LeaveOutLooks(&root) : mjcf::LeftOutLooks();
  if (!looks.text().empty()) notes->looks.push_back(file.string() + ": " + looks.text());
  for (const std::string& missing : looks.missing) {
    notes->warnings.push_back(missing + "; it was only looked at and is left out");
  }
  mjcf::RewriteForMujoco2(&root, &notes->rewrites);
#endif
  mjcf::RequireAssets(root);
  return root;
}

// The robot's tree and what it compiles to by itself, which makes every message name the right
// file.
struct LoadedRobot {
  mjcf::MjcfElement tree;
  mjcf::ModelHandle model;
};

LoadedRobot LoadRobot(const robot::RobotSpec& spec, const std::filesystem::path& file, Looks looks,
                      LoadNotes* notes) {
  InstallMujocoHooks();
  mjcf::MjcfElement tree = Read(file, looks, notes);
  mjcf::Revise(spec, &tree);
  mjcf::ModelHandle model = mjcf::CompileMjcf(tree);
  return {std::move(tree), std::move(model)};
}

mjcf::ModelHandle Compose(LoadedRobot robot, const robot::RobotSpec& spec,
                          const std::filesystem::path& robot_file,
                          const std::filesystem::path& scene_file, double timestep, Looks looks,
                          LoadNotes* notes) {
  RequireWhatSpecNames(*robot.model, spec, NameCheck(*robot.model, robot_file));
  mjcf::MjcfElement& world = robot.tree;
  const int base = mj_name2id(robot.model.get(), mjOBJ_BODY, spec.base_body.c_str());
  world.Set("model", spec.name);
  AddOurs(spec, HasFreeBase(*robot.model, base), &world);

  std::string place = robot_file.string();
  if (HasGround(*robot.model)) {
    if (notes != nullptr) {
      notes->warnings.push_back(place + " brings its own ground; the run's scene is left out");
    }
  } else {
    mjcf::MjcfElement scene = Read(scene_file, looks, notes);
    mjcf::CompileMjcf(scene);
    std::move(scene.children.begin(), scene.children.end(), std::back_inserter(world.children));
    place += " in " + scene_file.string();
  }
  MakeRoom(*robot.model, &world);
  mjcf::ModelHandle model;
  try {
    model = mjcf::CompileMjcf(world);
  } catch (const ModelError& error) {
    throw ModelError(place + ": " + error.what());
  }
  if (model->opt.integrator == mjINT_RK4) {  // either file may ask for it
    throw ModelError(
        place + ": integrator RK4 cannot be split around the motor law; use Euler or implicit");
  }
  UseFittedDynamics(spec, model.get());
  model->opt.timestep = timestep;
  model->opt.disableflags |= mjDSBL_ACTUATION;
  return model;
}

}  // namespace

void InstallMujocoHooks() {
  mju_user_error = OnMujocoError;
  mju_user_warning = OnMujocoWarning;
}

std::optional<std::string> TakeMujocoWarning() {
  const std::lock_guard lock(warning_mutex);
  if (last_warning[0] == '\0') return std::nullopt;
  std::string text(last_warning.data());
  last_warning.fill('\0');
  return text;
}

mjcf::ModelHandle LoadModelFile(const std::filesystem::path& file, LoadNotes* notes) {
  InstallMujocoHooks();
  const mjcf::MjcfElement root = Read(file, Looks::kLeftOut, notes);
  try {
    return mjcf::CompileMjcf(root);
  } catch (const ModelError&) {
    if (notes != nullptr) notes->unknown = mjcf::UnknownWords(root);
    throw;
  }
}

mjcf::ModelHandle LoadWorldModel(const robot::RobotSpec& spec,
                                 const std::filesystem::path& robot_file,
                                 const std::filesystem::path& scene_file, double timestep,
                                 LoadNotes* notes) {
  LoadedRobot robot = LoadRobot(spec, robot_file, Looks::kLeftOut, notes);
  RequireFeet(spec, NameCheck(*robot.model, robot_file));
  return Compose(std::move(robot), spec, robot_file, scene_file, timestep, Looks::kLeftOut, notes);
}

mjcf::ModelHandle LoadSightModel(const robot::RobotSpec& spec,
                                 const std::filesystem::path& robot_file,
                                 const std::filesystem::path& scene_file, double timestep) {
  const auto load = [&](Looks looks) {
    return Compose(LoadRobot(spec, robot_file, looks, nullptr), spec, robot_file, scene_file,
                   timestep, looks, nullptr);
  };
  try {
    return load(Looks::kKept);
  } catch (const ModelError&) {  // a file of looks is missing, or MuJoCo cannot read it
    return load(Looks::kLeftOut);
  }
}

FittedModel LoadFittedModel(const robot::RobotSpec& spec, const std::filesystem::path& robot_file,
                            const std::filesystem::path& scene_file, double timestep,
                            LoadNotes* notes) {
  LoadedRobot robot = LoadRobot(spec, robot_file, Looks::kLeftOut, notes);
  robot::RobotSpec fitted = mjcf::FitNames(spec, *robot.model, &notes->warnings);
  NoteFeet(*robot.model, fitted, notes);
  mjcf::ModelHandle model =
      Compose(std::move(robot), fitted, robot_file, scene_file, timestep, Looks::kLeftOut, notes);
  return {std::move(fitted), std::move(model)};
}

}  // namespace understudy::physics
