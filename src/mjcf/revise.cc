#include "mjcf/revise.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "mjcf/joints.h"
#include "robot/lens.h"
#include "robot/rotations.h"

namespace understudy::mjcf {
namespace {

// Returns the element of that kind and name below `parent`, null if there is none. Defaults and
// sections that only refer to elements have none with a name.
MjcfElement* FindNamed(MjcfElement* parent, const std::string& kind, const std::string& name) {
  for (MjcfElement& child : parent->children) {
    if (child.name == kind && child.Get("name") == name) return &child;
    if (MjcfElement* found = FindNamed(&child, kind, name)) return found;
  }
  return nullptr;
}

void CollectNames(const MjcfElement& parent, const std::string& kind,
                  std::vector<std::string>* names) {
  for (const MjcfElement& child : parent.children) {
    if (child.name == kind && child.Find("name") != nullptr) names->push_back(child.Get("name"));
    CollectNames(child, kind, names);
  }
}

MjcfElement& Require(MjcfElement* root, const std::string& kind, const std::string& name,
                     const std::string& key) {
  if (MjcfElement* found = FindNamed(root, kind, name)) return *found;
  std::vector<std::string> names;
  CollectNames(*root, kind, &names);
  throw ModelError(root->place.file + ": no " + kind + " '" + name + "'" +
                   NearestHint(name, names) + " (" + key + ".name names it)");
}

void ReviseBody(const robot::BodySpec& spec, const std::string& key, MjcfElement* root) {
  MjcfElement& body = Require(root, "body", spec.name, key);
  if (!spec.pos.empty()) body.Set("pos", NumbersText(spec.pos));
  const bool all = spec.mass > 0 && !spec.com.empty() && !spec.inertia.empty();
  const bool none = spec.mass == 0 && spec.com.empty() && spec.inertia.empty();
  if (none) return;
  auto inertial = std::ranges::find(body.children, "inertial", &MjcfElement::name);
  if (inertial == body.children.end()) {
    if (!all) {
      throw ModelError(body.place.text() + ": " + key + ": the file leaves mass and inertia of '" +
                       spec.name + "' to its geoms; expected all of mass, com and inertia");
    }
    body.children.insert(
        body.children.begin(),
        {.name = "inertial", .attributes = {}, .children = {}, .place = body.place});
    inertial = body.children.begin();
  }
  if (spec.mass > 0) inertial->Set("mass", NumbersText({&spec.mass, 1}));
  if (!spec.com.empty()) inertial->Set("pos", NumbersText(spec.com));
  if (spec.inertia.empty()) return;
  for (const char* other : {"diaginertia", "quat", "axisangle", "xyaxes", "zaxis", "euler"}) {
    inertial->Drop(other);
  }
  inertial->Set("fullinertia", NumbersText(spec.inertia));
}

bool IsAny(const std::string* name, const std::vector<std::string>& names) {
  return name != nullptr && std::ranges::find(names, *name) != names.end();
}

// Removes all elements for which `is_out` holds, with their children.
template <class F>
void TakeOut(MjcfElement* parent, F is_out) {
  std::erase_if(parent->children, is_out);
  for (MjcfElement& child : parent->children) TakeOut(&child, is_out);
}

void Lock(const std::vector<std::string>& joints, MjcfElement* root) {
  std::vector<std::string> actuators;
  TakeOut(root, [&](const MjcfElement& element) {
    const bool is_joint = element.name == "joint" && IsAny(element.Find("name"), joints) &&
                          element.Find("joint1") == nullptr;
    const bool refers = IsAny(element.Find("joint"), joints) ||
                        IsAny(element.Find("joint1"), joints) ||
                        IsAny(element.Find("joint2"), joints);
    if (refers && element.Find("name") != nullptr) actuators.push_back(element.Get("name"));
    return is_joint || refers;
  });
  TakeOut(root,
          [&](const MjcfElement& element) { return IsAny(element.Find("actuator"), actuators); });
}

// `left` is how far the eye is to the left of the camera's place [m].
void AddEye(const robot::CameraSpec& camera, const std::string& name, double left,
            MjcfElement* root, MjcfElement* body) {
  TakeOut(root, [&](const MjcfElement& element) {
    return element.name == "camera" && element.Get("name") == name;
  });
  // MuJoCo's cameras look along -z, with x to the right and y up.
  const Eigen::Matrix3d R_BC = robot::FromRollPitchYaw(camera.rpy);
  const Eigen::Vector3d right = -R_BC.col(1);
  const Eigen::Vector3d up = R_BC.col(2);
  const Eigen::Vector3d pos = camera.pos - left * right;
  const double fovy = 2 * std::atan(robot::ReachOf(camera).y()) * 180 / std::numbers::pi;
  MjcfElement element{.name = "camera", .attributes = {}, .children = {}, .place = body->place};
  element.Set("name", name);
  element.Set("pos", NumbersText({pos.data(), 3}));
  element.Set("xyaxes", NumbersText({right.data(), 3}) + " " + NumbersText({up.data(), 3}));
  element.Set("fovy", NumbersText({&fovy, 1}));
  body->children.push_back(std::move(element));
}

}  // namespace

void Revise(const robot::RobotSpec& spec, MjcfElement* root) {
  for (std::size_t i = 0; i < spec.bodies.size(); ++i) {
    ReviseBody(spec.bodies[i], "robot.bodies." + std::to_string(i), root);
  }
  for (std::size_t i = 0; i < spec.sites.size(); ++i) {
    const robot::SiteSpec& site = spec.sites[i];
    MjcfElement* base = FindNamed(root, "body", spec.base_body);
    if (site.name == spec.imu.site && base != nullptr && !FindNamed(root, "site", site.name)) {
      base->children.push_back({"site", {{"name", site.name}}, {}, base->place});
    }
    Require(root, "site", site.name, "robot.sites." + std::to_string(i))
        .Set("pos", NumbersText({site.pos.data(), 3}));
  }
  for (const robot::MotorSpec* motor : robot::AllMotors(spec)) {
    if (motor->armature == 0) continue;
    // A missing joint is refused or renamed after the model is compiled.
    MjcfElement* joint = FindNamed(root, "joint", motor->joint);
    if (joint != nullptr) joint->Set("armature", NumbersText({&motor->armature, 1}));
  }
  if (!spec.locked_joints.empty()) Lock(spec.locked_joints, root);
}

void AddCameras(const robot::RobotSpec& spec, MjcfElement* root) {
  for (std::size_t i = 0; i < spec.cameras.size(); ++i) {
    const robot::CameraSpec& camera = spec.cameras[i];
    MjcfElement& body = Require(root, "body", camera.body.empty() ? spec.base_body : camera.body,
                                "robot.cameras." + std::to_string(i) + ".body");
    AddEye(camera, camera.name, camera.baseline / 2, root, &body);
    if (!robot::IsBinocular(camera)) continue;
    AddEye(camera, robot::RightEyeName(camera), -camera.baseline / 2, root, &body);
  }
}

}  // namespace understudy::mjcf
