#include "mjcf/fit_names.h"

#include <algorithm>
#include <cctype>

#include <mujoco/mujoco.h>

#include "robot/drop_motor.h"

namespace understudy::mjcf {
namespace {

constexpr std::string_view kJoint = "_joint";

bool Has(const mjModel& model, mjtObj type, const std::string& name) {
  return mj_name2id(&model, type, name.c_str()) >= 0;
}

std::string Name(const mjModel& model, mjtObj type, int id) {
  const char* name = mj_id2name(&model, type, id);
  return name == nullptr ? "" : name;
}

// Returns the only root body with a free joint; "" if there is none, it has no name or there are
// more.
std::string FreeBody(const mjModel& model) {
  std::string found;
  for (int joint = 0; joint < static_cast<int>(model.njnt); ++joint) {
    if (model.jnt_type[joint] != mjJNT_FREE) continue;
    if (!found.empty()) return "";
    found = Name(model, mjOBJ_BODY, model.jnt_bodyid[joint]);
  }
  return found;
}

bool SaysImu(std::string name) {
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
  return name.find("imu") != std::string::npos;
}

// Returns the only IMU site of those bodies, "" if there is none or more than one.
template <class F>
std::string OnlyImu(const mjModel& model, F is_there) {
  std::string found;
  for (int site = 0; site < static_cast<int>(model.nsite); ++site) {
    const std::string name = Name(model, mjOBJ_SITE, site);
    if (!SaysImu(name) || !is_there(model.site_bodyid[site])) continue;
    if (!found.empty()) return "";
    found = name;
  }
  return found;
}

bool HasImu(const mjModel& model) {
  for (int site = 0; site < static_cast<int>(model.nsite); ++site) {
    if (SaysImu(Name(model, mjOBJ_SITE, site))) return true;
  }
  return false;
}

std::string OtherSpelling(const std::string& joint) {
  if (!joint.ends_with(kJoint)) return joint + std::string(kJoint);
  return joint.substr(0, joint.size() - kJoint.size());
}

void FitBodies(const mjModel& model, robot::RobotSpec* spec, std::vector<std::string>* notes) {
  if (!Has(model, mjOBJ_BODY, spec->base_body)) {
    const std::string free = FreeBody(model);
    if (free.empty()) return;
    notes->push_back("base body '" + spec->base_body + "': the model calls it '" + free + "'");
    if (spec->crane_body == spec->base_body) spec->crane_body = free;
    spec->base_body = free;
  }
  if (!spec->lidar.body.empty() && !Has(model, mjOBJ_BODY, spec->lidar.body)) {
    notes->push_back("the model has no body '" + spec->lidar.body + "': the robot has no lidar");
    spec->lidar.make = "none";
  }
  std::erase_if(spec->cameras, [&](const robot::CameraSpec& camera) {
    if (camera.body.empty() || Has(model, mjOBJ_BODY, camera.body)) return false;
    notes->push_back("the model has no body '" + camera.body + "': the robot has no camera '" +
                     camera.name + "'");
    return true;
  });
  if (Has(model, mjOBJ_BODY, spec->crane_body)) return;
  notes->push_back("the model has no body '" + spec->crane_body +
                   "': the crane's hook is in the base");
  spec->crane_body = spec->base_body;
  spec->crane_point = {0, 0, 0};
}

void FitImu(const mjModel& model, robot::RobotSpec* spec, std::vector<std::string>* notes) {
  const int base = mj_name2id(&model, mjOBJ_BODY, spec->base_body.c_str());
  const auto note = [&](const std::string& what, const std::string& was, const std::string& is) {
    notes->push_back(what + " '" + was + "': the model calls it '" + is + "'");
  };
  robot::ImuSpec& imu = spec->imu;
  if (!Has(model, mjOBJ_SITE, imu.site)) {
    std::string site = OnlyImu(model, [](int) { return true; });
    if (site.empty()) site = OnlyImu(model, [base](int body) { return body == base; });
    if (site.empty()) {
      if (HasImu(model) || base < 0) return;
      notes->push_back("the model has no IMU site: the unit is at the origin of '" +
                       spec->base_body + "'; robot.sites moves it");
      spec->sites.push_back({.name = imu.site});  // Revise adds it
    } else {
      note("IMU site", imu.site, site);
      imu.site = site;
    }
  }
  if (imu.secondary_site.empty() || Has(model, mjOBJ_SITE, imu.secondary_site)) return;
  const int site = mj_name2id(&model, mjOBJ_SITE, imu.site.c_str());
  const int first = site < 0 ? base : model.site_bodyid[site];
  const std::string other = OnlyImu(model, [first](int body) { return body != first; });
  if (other.empty()) {
    notes->push_back("the model has no IMU site '" + imu.secondary_site +
                     "': the robot has no second unit");
  } else {
    note("IMU site", imu.secondary_site, other);
  }
  imu.secondary_site = other;
}

void FitMotors(const mjModel& model, robot::RobotSpec* spec, std::vector<std::string>* notes) {
  std::vector<std::size_t> without;
  int renamed = 0;
  for (std::size_t i = 0; i < spec->motors.size(); ++i) {
    std::string& joint = spec->motors[i].joint;
    if (Has(model, mjOBJ_JOINT, joint)) continue;
    if (Has(model, mjOBJ_JOINT, OtherSpelling(joint))) {
      joint = OtherSpelling(joint);
      ++renamed;
    } else {
      without.push_back(i);
    }
  }
  if (renamed > 0) {
    notes->push_back(std::to_string(renamed) + " joints are called with or without '_joint' there");
  }
  if (2 * without.size() >= spec->motors.size()) return;  // another robot
  for (auto i = without.rbegin(); i != without.rend(); ++i) {
    const robot::MotorSpec& motor = spec->motors[*i];
    notes->push_back("the model has no joint '" + motor.joint + "': slot " +
                     std::to_string(motor.slot) + " has no motor");
    robot::DropMotor(*i, spec);
  }
}

}  // namespace

robot::RobotSpec FitNames(robot::RobotSpec spec, const mjModel& model,
                          std::vector<std::string>* notes) {
  FitBodies(model, &spec, notes);
  FitMotors(model, &spec, notes);
  FitImu(model, &spec, notes);
  return spec;
}

}  // namespace understudy::mjcf
