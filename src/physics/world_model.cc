#include "physics/world_model.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include <mujoco/mujoco.h>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "mjcf/assets.h"
#include "mjcf/compile.h"
#include "mjcf/fit_names.h"
#include "mjcf/join.h"
#include "mjcf/look.h"
#include "mjcf/looks.h"
#include "mjcf/mount.h"
#include "mjcf/mujoco_hooks.h"
#include "mjcf/revise.h"
#include "objects/object_bodies.h"
#include "physics/feet.h"
#include "physics/geom_extent.h"
#include "physics/joint_dynamics.h"

namespace understudy::physics {
namespace {

// The robot's tree and the model of it alone, so that messages name the right file.
struct LoadedRobot {
  mjcf::MjcfElement tree;
  mjcf::ModelHandle model;
};

mjcf::MjcfElement Element(const std::string& name,
                          std::vector<std::pair<std::string, std::string>> attributes) {
  return {.name = name, .attributes = std::move(attributes), .children = {}, .place = {}};
}

// Adds what fixes a free base to the robot's tree.
void AddClamp(const std::string& base, mjcf::MjcfElement* root) {
  // Stiffness of the clamp, a time constant of 4 ms without overshoot: assumed.
  mjcf::MjcfElement equality = Element("equality", {});
  equality.children.push_back(Element(
      "weld", {{"name", kClampName}, {"body1", base}, {"active", "false"}, {"solref", "0.004 1"}}));
  root->children.push_back(std::move(equality));
}

// Reserves memory for contacts, which MuJoCo 2 allocates in advance and MuJoCo 3 as needed. The
// most seen is a G1 that struggles on rough ground: 68 contacts, 302 rows. Twice that is room; the
// memory, and the time to begin anew, grow with the square of the rows.
void MakeRoom(const std::vector<LoadedRobot>& robots, std::size_t objects,
              mjcf::MjcfElement* root) {
#if mjVERSION_HEADER < 300
  constexpr int kContacts = 150, kRows = 600;
  // A box lies on another by eight corners of four rows each, and half as much is room: assumed.
  constexpr int kContactsOfObject = 12, kRowsOfObject = 48;
  int contacts = kContactsOfObject * static_cast<int>(objects);
  int rows = kRowsOfObject * static_cast<int>(objects);
  for (const LoadedRobot& robot : robots) {
    contacts += std::max(robot.model->nconmax, kContacts);
    rows += std::max(robot.model->njmax, kRows);
  }
  root->children.push_back(
      Element("size", {{"nconmax", std::to_string(contacts)}, {"njmax", std::to_string(rows)}}));
#else
  (void)robots;
  (void)objects;
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

// Checks that the model has all elements that the description names.
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
    throw ModelError(file_ + ": no " + what + " '" + name + "'" + NearestHint(name, Names(type)) +
                     " (" + key + " names it)");
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

// Refuses the model of another robot, such as an arm's for a robot with legs.
void RequireSameRobot(const robot::RobotSpec& spec, const NameCheck& check) {
  const auto moves = [&](const robot::MotorSpec& motor) {
    return check.Has(mjOBJ_JOINT, motor.joint);
  };
  if (check.Has(mjOBJ_BODY, spec.base_body) || std::ranges::any_of(spec.motors, moves)) return;
  check.Refuse("no model of a '" + spec.name + "': it has neither its base body '" +
               spec.base_body + "' nor any of its " + std::to_string(spec.motors.size()) +
               " motors' joints. Name the robot that it is (understudy robots), or describe one of "
               "your own (docs/own_robot.md)");
}

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
  RequireSameRobot(spec, check);
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
  for (std::size_t i = 0; i < spec.cameras.size(); ++i) {
    if (spec.cameras[i].body.empty()) continue;
    check.Require(mjOBJ_BODY, "body", spec.cameras[i].body,
                  "robot.cameras." + std::to_string(i) + ".body");
  }
  check.Require(mjOBJ_BODY, "crane body", spec.crane_body, "robot.crane_body");
}

// Adds notes on the geoms used as feet of a third-party model.
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
        count == 0 ? "foot " + name + ": the model has none of its geoms, so it feels no force; " +
                         FeetRemedy(foot)
                   : "foot " + name + ": " + std::to_string(count) + " geom" +
                         (count == 1 ? "" : "s") + " of body '" + body + "', the lowest there");
  }
}

// Whether visual-only elements are compiled too.
enum class Looks { kLeftOut, kKept };

mjcf::MjcfElement Read(const std::filesystem::path& file, [[maybe_unused]] Looks kept,
                       LoadNotes* notes) {
  LoadNotes unread;
  if (notes == nullptr) notes = &unread;
  mjcf::MjcfElement root = mjcf::ReadMjcf(file);
#if mjVERSION_HEADER < 300
  // MuJoCo 2.2.2 compiles invisible elements slowly, too.
  const mjcf::LeftOutLooks looks =
      kept == Looks::kLeftOut ? mjcf::LeaveOutLooks(&root) : mjcf::LeftOutLooks();
  if (!looks.text().empty()) notes->looks.push_back(file.string() + ": " + looks.text());
  for (const std::string& missing : looks.missing) {
    notes->warnings.push_back(missing + "; visual mesh skipped");
  }
  mjcf::RewriteForMujoco2(&root, &notes->rewrites);
#endif
  mjcf::RequireAssets(root);
  return root;
}

mjcf::MjcfElement ReadRobot(const PlacedRobot& robot, Looks looks, LoadNotes* notes) {
  mjcf::InstallMujocoHooks();
  mjcf::MjcfElement tree = Read(robot.file, looks, notes);
  std::vector<mjcf::MjcfElement> hands;
  for (const std::filesystem::path& file : robot.hands) hands.push_back(Read(file, looks, notes));
  mjcf::MountHands(robot.spec, std::move(hands), &tree);
  mjcf::Revise(robot.spec, &tree);
  return tree;
}

LoadedRobot LoadRobot(const PlacedRobot& robot, Looks looks, LoadNotes* notes) {
  mjcf::MjcfElement tree = ReadRobot(robot, looks, notes);
  mjcf::ModelHandle model = mjcf::CompileMjcf(tree);
  return {std::move(tree), std::move(model)};
}

// Checks the robot against its description, adds its clamp, and moves it to its place.
void Prepare(const PlacedRobot& placed, LoadedRobot* robot) {
  const robot::RobotSpec& spec = placed.spec;
  RequireWhatSpecNames(*robot->model, spec, NameCheck(*robot->model, placed.file));
  const int base = mj_name2id(robot->model.get(), mjOBJ_BODY, spec.base_body.c_str());
  robot->tree.Set("model", spec.name);
  if (HasFreeBase(*robot->model, base)) AddClamp(spec.base_body, &robot->tree);
  mjcf::MoveBodies(placed.x, placed.y, &robot->tree);
}

// One tree of all robots. A single one keeps its names.
mjcf::MjcfElement JoinRobots(const std::vector<PlacedRobot>& placed,
                             std::vector<LoadedRobot>* robots, LoadNotes* notes) {
  mjcf::MjcfElement world = std::move(robots->front().tree);
  if (robots->size() == 1) return world;
  LoadNotes unread;
  if (notes == nullptr) notes = &unread;
  mjcf::AddPrefix(placed.front().prefix, &world);
  for (std::size_t i = 1; i < robots->size(); ++i) {
    mjcf::MjcfElement& tree = (*robots)[i].tree;
    mjcf::AddPrefix(placed[i].prefix, &tree);
    mjcf::Join(std::move(tree), &world, &notes->warnings);
  }
  return world;
}

// Compiles and adds MuJoCo's warnings to the notes.
mjcf::ModelHandle Compile(const mjcf::MjcfElement& root, LoadNotes* notes) {
  std::string warning;
  mjcf::ModelHandle model = mjcf::CompileMjcf(root, &warning);
  if (notes != nullptr && !warning.empty()) notes->warnings.push_back(warning);
  return model;
}

mjcf::ModelHandle Compose(const std::vector<PlacedRobot>& placed, std::vector<LoadedRobot> robots,
                          const Surroundings& around, double timestep, Looks looks,
                          LoadNotes* notes) {
  std::string place;
  bool has_ground = false;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    Prepare(placed[i], &robots[i]);
    place += (i == 0 ? "" : ", ") + placed[i].file.string();
    if (!HasGround(*robots[i].model)) continue;
    has_ground = true;
    if (notes == nullptr) continue;
    notes->warnings.push_back(placed[i].file.string() +
                              " brings its own ground; the run's scene is left out");
  }
  mjcf::MjcfElement world = JoinRobots(placed, &robots, notes);
  if (!has_ground) {
    mjcf::MjcfElement scene = Read(around.file, looks, notes);
    objects::RequireOwnNames(around.objects, *mjcf::CompileMjcf(scene), around.file);
    std::move(scene.children.begin(), scene.children.end(), std::back_inserter(world.children));
    place += " in " + around.file.string();
  }
  if (!around.objects.empty()) {
    objects::RequirePictures(around.objects);
    // Names of several robots' bodies have a slash.
    if (placed.size() == 1)
      objects::RequireOwnNames(around.objects, *robots[0].model, placed[0].file);
    world.children.push_back(objects::MakeObjectBodies(
        around.objects,
        looks == Looks::kKept ? objects::Prints::kKept : objects::Prints::kLeftOut));
    if (looks == Looks::kKept) {
      world.children.push_back(objects::MakePictures(around.objects));
    }
    if (std::ranges::any_of(around.objects, objects::Walks)) {
      world.children.push_back(objects::MakeExclusions(around.objects));
    }
  }
  MakeRoom(robots, around.objects.size(), &world);
  mjcf::ModelHandle model;
  try {
    model = Compile(world, notes);
  } catch (const ModelError& error) {
    throw ModelError(place + ": " + error.what());
  }
  if (model->opt.integrator == mjINT_RK4) {  // any of the files may ask for it
    throw ModelError(
        place + ": integrator RK4 cannot be split around the motor law; use Euler or implicit");
  }
  for (const PlacedRobot& robot : placed) {
    UseFittedDynamics(mjcf::WithPrefix(robot.prefix, robot.spec), model.get());
  }
  model->opt.timestep = timestep;
  // Robots share few constraints: dense, two Go2 take a third more than twice the time of one.
  if (placed.size() > 1) model->opt.jacobian = mjJAC_SPARSE;
  model->opt.disableflags |= mjDSBL_ACTUATION | mjDSBL_SENSOR;
  return model;
}

}  // namespace

mjcf::ModelHandle LoadModelFile(const std::filesystem::path& file, LoadNotes* notes) {
  mjcf::InstallMujocoHooks();
  const mjcf::MjcfElement root = Read(file, Looks::kLeftOut, notes);
  try {
    return Compile(root, notes);
  } catch (const ModelError&) {
    if (notes != nullptr) notes->unknown = mjcf::UnknownWords(root);
    throw;
  }
}

mjcf::ModelHandle LoadWorldModel(const std::vector<PlacedRobot>& robots, const Surroundings& around,
                                 double timestep, LoadNotes* notes) {
  std::vector<LoadedRobot> loaded;
  for (const PlacedRobot& robot : robots) {
    loaded.push_back(LoadRobot(robot, Looks::kLeftOut, notes));
    RequireFeet(robot.spec, NameCheck(*loaded.back().model, robot.file));
  }
  return Compose(robots, std::move(loaded), around, timestep, Looks::kLeftOut, notes);
}

mjcf::ModelHandle LoadSightModel(const std::vector<PlacedRobot>& robots, const Surroundings& around,
                                 double timestep, const std::vector<std::string>& looks) {
  const auto load = [&](Looks kept, const std::vector<std::string>& by) {
    std::vector<LoadedRobot> loaded;
    std::vector<mjcf::Look> worn;  // until all is compiled: the files of some are temporary
    for (std::size_t i = 0; i < robots.size(); ++i) {
      loaded.push_back(LoadRobot(robots[i], kept, nullptr));
      mjcf::MjcfElement& tree = loaded.back().tree;
      if (i < by.size() && !by[i].empty()) {
        worn.push_back(mjcf::FindLook(by[i], tree));
        mjcf::PutOn(worn.back(), &tree);
      }
      mjcf::AddCameras(robots[i].spec, &tree);
    }
    return Compose(robots, std::move(loaded), around, timestep, kept, nullptr);
  };
  // A file of looks may have gone since the start, or there is no room for those made of it.
  try {
    return load(Looks::kKept, looks);
  } catch (const SetupError&) {
  }
  try {
    return load(Looks::kKept, {});
  } catch (const ModelError&) {
    return load(Looks::kLeftOut, {});
  }
}

std::string CheckLook(const PlacedRobot& robot, const std::string& look) {
  const mjcf::Look found = mjcf::FindLook(look, ReadRobot(robot, Looks::kLeftOut, nullptr));
  mjcf::MjcfElement asset = Element("asset", {});
  asset.children = found.meshes;
  mjcf::MjcfElement meshes = Element("mujoco", {});
  meshes.children.push_back(std::move(asset));
  mjcf::CompileMjcf(meshes);
  return found.file.string() + ", " + std::to_string(found.bodies.size()) + " bodies";
}

FittedModel LoadFittedModel(const PlacedRobot& robot, const Surroundings& around, double timestep,
                            LoadNotes* notes) {
  std::vector<LoadedRobot> loaded;
  loaded.push_back(LoadRobot(robot, Looks::kLeftOut, notes));
  const mjModel& own = *loaded.front().model;
  PlacedRobot fitted = robot;
  fitted.spec = mjcf::FitNames(robot.spec, own, &notes->warnings);
  const bool adds_site = fitted.spec.sites.size() > robot.spec.sites.size();
  NoteFeet(own, fitted.spec, notes);
  if (adds_site) loaded.front() = LoadRobot(fitted, Looks::kLeftOut, nullptr);
  mjcf::ModelHandle model =
      Compose({fitted}, std::move(loaded), around, timestep, Looks::kLeftOut, notes);
  return {std::move(fitted.spec), std::move(model)};
}

}  // namespace understudy::physics
