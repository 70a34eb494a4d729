#include "physics/world_model.h"

#include <array>
#include <cstring>
#include <mutex>
#include <vector>

#include "robot/errors.h"
#include "robot/nearest_word.h"

namespace understudy {
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

ModelHandle Compile(const std::string& file, const mjVFS* vfs) {
  std::array<char, 1000> error{};
  ModelHandle model(mj_loadXML(file.c_str(), vfs, error.data(), static_cast<int>(error.size())));
  if (!model) {
    std::string text(error.data());
    for (char& c : text) {
      if (c == '\n') c = ' ';
    }
    throw ModelError(text);
  }
  return model;
}

// XML files that MuJoCo finds by name instead of on disk.
class MemoryFiles {
 public:
  MemoryFiles() : vfs_(std::make_unique<mjVFS>()) { mj_defaultVFS(vfs_.get()); }
  ~MemoryFiles() { mj_deleteVFS(vfs_.get()); }
  MemoryFiles(const MemoryFiles&) = delete;
  MemoryFiles& operator=(const MemoryFiles&) = delete;

  void Add(const std::string& name, const std::string& text) {
    mj_makeEmptyFileVFS(vfs_.get(), name.c_str(), static_cast<int>(text.size()));
    const int i = mj_findFileVFS(vfs_.get(), name.c_str());
    std::memcpy(vfs_->filedata[i], text.data(), text.size());
  }
  const mjVFS* get() const { return vfs_.get(); }

 private:
  std::unique_ptr<mjVFS> vfs_;
};

std::string Attribute(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return '"' + escaped + '"';
}

std::string ImuSensors(const std::string& site, const char* gyro, const char* accel) {
  if (site.empty()) return {};
  return "<gyro name=\"" + std::string(gyro) + "\" site=" + Attribute(site) +
         "/><accelerometer name=\"" + accel + "\" site=" + Attribute(site) + "/>";
}

std::string ComposeWorld(const RobotSpec& spec, const std::filesystem::path& robot_file,
                         const std::filesystem::path& scene_file) {
  return "<mujoco model=" + Attribute(spec.name) +
         "><include file=" + Attribute(robot_file.string()) +
         "/><include file=" + Attribute(scene_file.string()) + "/><equality><weld name=\"" +
         kClampName + "\" body1=" + Attribute(spec.base_body) +
         " active=\"false\" solref=\"0.004 1\"/></equality><sensor>" +
         ImuSensors(spec.imu.site, kImuGyroName, kImuAccelName) +
         ImuSensors(spec.imu.secondary_site, kSecondaryGyroName, kSecondaryAccelName) +
         "</sensor></mujoco>";
}

void RequireName(const mjModel& model, mjtObj type, const char* kind, const std::string& name,
                 const std::filesystem::path& file) {
  if (mj_name2id(&model, type, name.c_str()) >= 0) return;
  int count = 0;
  switch (type) {
    case mjOBJ_BODY:
      count = model.nbody;
      break;
    case mjOBJ_JOINT:
      count = model.njnt;
      break;
    case mjOBJ_SITE:
      count = model.nsite;
      break;
    default:
      count = model.ngeom;
  }
  std::vector<std::string> names;
  for (int i = 0; i < count; ++i) {
    if (const char* text = mj_id2name(&model, type, i); text != nullptr && *text != '\0') {
      names.emplace_back(text);
    }
  }
  const std::string nearest = NearestWord(name, names);
  throw ModelError(file.string() + ": no " + kind + " '" + name + "'" +
                   (nearest.empty() ? "" : "; did you mean '" + nearest + "'?"));
}

void RequireWhatSpecNames(const mjModel& model, const RobotSpec& spec,
                          const std::filesystem::path& file) {
  RequireName(model, mjOBJ_BODY, "base body", spec.base_body, file);
  const int base = mj_name2id(&model, mjOBJ_BODY, spec.base_body.c_str());
  if (model.body_jntnum[base] != 1 || model.jnt_type[model.body_jntadr[base]] != mjJNT_FREE) {
    throw ModelError(file.string() + ": base body '" + spec.base_body +
                     "' has no free joint; add <freejoint/> to it");
  }
  for (const MotorSpec& motor : spec.motors) {
    RequireName(model, mjOBJ_JOINT, "joint", motor.joint, file);
    const int joint = mj_name2id(&model, mjOBJ_JOINT, motor.joint.c_str());
    if (model.jnt_type[joint] != mjJNT_HINGE && model.jnt_type[joint] != mjJNT_SLIDE) {
      throw ModelError(file.string() + ": joint '" + motor.joint +
                       "' of a motor must be a hinge or a slide");
    }
  }
  RequireName(model, mjOBJ_SITE, "IMU site", spec.imu.site, file);
  if (!spec.imu.secondary_site.empty()) {
    RequireName(model, mjOBJ_SITE, "IMU site", spec.imu.secondary_site, file);
  }
  RequireName(model, mjOBJ_BODY, "crane body", spec.crane_body, file);
  for (const FootSpec& foot : spec.feet) {
    for (const std::string& geom : foot.geoms) {
      RequireName(model, mjOBJ_GEOM, "foot geom", geom, file);
    }
  }
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

ModelHandle LoadModelFile(const std::filesystem::path& file) {
  InstallMujocoHooks();
  if (!std::filesystem::is_regular_file(file)) {
    throw ModelError(file.string() + ": no such file");
  }
  try {
    return Compile(file.string(), nullptr);
  } catch (const ModelError& error) {
    throw ModelError(file.string() + ": " + error.what());
  }
}

ModelHandle LoadWorldModel(const RobotSpec& spec, const std::filesystem::path& robot_file,
                           const std::filesystem::path& scene_file, double timestep) {
  InstallMujocoHooks();
  // Each file by itself first costs a few milliseconds and makes every message name the right file.
  RequireWhatSpecNames(*LoadModelFile(robot_file), spec, robot_file);
  LoadModelFile(scene_file);

  // The composed file stands beside the robot's: MuJoCo looks for includes, meshes and textures
  // from the folder of the outermost file, and takes no absolute path there.
  const std::filesystem::path robot = std::filesystem::absolute(robot_file);
  const std::filesystem::path folder = robot.parent_path();
  const std::string name = folder / "understudy_world.xml";
  MemoryFiles files;
  files.Add(name,
            ComposeWorld(spec, robot.filename(), std::filesystem::relative(scene_file, folder)));
  const std::string place = robot_file.string() + " in " + scene_file.string() + ": ";
  ModelHandle model;
  try {
    model = Compile(name, files.get());
  } catch (const ModelError& error) {
    throw ModelError(place + error.what());
  }
  if (model->opt.integrator == mjINT_RK4) {  // either file may ask for it
    throw ModelError(place +
                     "integrator RK4 cannot be split around the motor law; use Euler or implicit");
  }
  model->opt.timestep = timestep;
  model->opt.disableflags |= mjDSBL_ACTUATION;
  return model;
}

}  // namespace understudy
