#include <cmath>
#include <numbers>

#include <mujoco/mujoco.h>

#include "base/errors.h"
#include "mjcf/actuators.h"
#include "mjcf/compile.h"

namespace understudy::mjcf {
namespace {

constexpr std::array<const char*, 1> kPositionKinds = {"position"};
constexpr std::array<const char*, 2> kGainKinds = {"position", "general"};

// A position actuator whose kv depends on the inertia of its joint.
struct Pending {
  std::size_t index;  // among all actuators
  double kp, ratio;
};

void SetGains(MjcfElement* actuator, double kp, double kv) {
  const double bias[] = {0, -kp, -kv};
  const double gain[] = {kp};
  actuator->Set("dyntype", "none");
  actuator->Set("gaintype", "fixed");
  actuator->Set("biastype", "affine");
  actuator->Set("gainprm", NumbersText(gain));
  actuator->Set("biasprm", NumbersText(bias));
}

void DropGains(MjcfElement* element) {
  if (element->name == "position") {
    for (const char* spent : {"kv", "dampratio", "inheritrange"}) element->Drop(spent);
  }
  for (MjcfElement& child : element->children) DropGains(&child);
}

std::string InheritedRange(const MjcfElement& actuator, const MjcfJoint* joint, double share,
                           bool in_degrees) {
  if (joint == nullptr || !joint->range) {
    throw ModelError(actuator.place.text() + ": inheritrange of actuator '" + actuator.Get("name") +
                     "' needs a hinge or slide with a range");
  }
  const auto [low, high] = *joint->range;
  const bool is_slide = joint->type == "slide";
  const double unit = in_degrees && !is_slide ? std::numbers::pi / 180 : 1;
  const double mean = 0.5 * (low + high) * unit, half = 0.5 * (high - low) * unit * share;
  const double range[] = {mean - half, mean + half};
  return NumbersText(range);
}

}  // namespace

void SpellOutPositionGains(MjcfElement* root, const MjcfDefaults& defaults, MjcfJoints* joints,
                           std::vector<Rewrite>* rewrites) {
  const std::string angle = CompilerSays(*root, "angle");
  const bool in_degrees = angle.empty() || angle == "degree";
  std::vector<Pending> pending;
  for (std::size_t i = 0; i < joints->actuators.size(); ++i) {
    MjcfElement& actuator = *joints->actuators[i];
    if (actuator.name != "position") continue;
    const std::string own_class = actuator.Get("class");
    const auto damping = defaults.Find(actuator, own_class, kPositionKinds, {"kv", "dampratio"});
    const auto inherit = defaults.Find(actuator, own_class, kPositionKinds, {"inheritrange"});
    if (!damping && !inherit) continue;
    MjcfJoint* joint =
        joints->Find(actuator.Get(actuator.Find("joint") != nullptr ? "joint" : "jointinparent"));
    if (joint != nullptr && !joint->scalar()) joint = nullptr;

    const auto gain = defaults.Find(actuator, own_class, kGainKinds, {"kp", "gainprm"});
    const double kp = gain ? ReadNumbers(*gain, gain->attribute, 1)[0] : 1;
    double kv = 0;
    if (damping) {
      const double number = ReadNumbers(*damping, damping->attribute, 1)[0];
      if (damping->attribute == "kv") {
        kv = number;
      } else if (joint == nullptr || kp < 0 || number < 0) {
        throw ModelError(actuator.place.text() + ": dampratio of actuator '" +
                         actuator.Get("name") +
                         "' needs a hinge or slide and neither kp nor itself negative");
      } else {
        pending.push_back({i, kp, number});
      }
    }
    if (inherit) {
      const double share = ReadNumbers(*inherit, "inheritrange", 1)[0];
      if (share > 0) {
        actuator.Set("ctrllimited", "true");
        actuator.Set("ctrlrange", InheritedRange(actuator, joint, share, in_degrees));
      }
    }
    actuator.name = "general";
    for (const char* spent : {"kp", "kv", "dampratio", "inheritrange"}) actuator.Drop(spent);
    SetGains(&actuator, kp, kv);
    rewrites->push_back({actuator.place,
                         "position actuator '" + actuator.Get("name") +
                             "' became a general one with gains and range spelled out",
                         "kv, dampratio and inheritrange are new in MuJoCo 3"});
  }
  DropGains(root);
  if (pending.empty()) return;

  const ModelHandle model = CompileMjcf(*root);
  for (const Pending& one : pending) {
    const int actuator = static_cast<int>(one.index);
    const int dof = model->jnt_dofadr[model->actuator_trnid[2 * actuator]];
    const double gear = model->actuator_gear[6 * actuator];
    const double inertia = model->dof_M0[dof] / (gear * gear);
    SetGains(joints->actuators[one.index], one.kp, 2 * one.ratio * std::sqrt(one.kp * inertia));
  }
}

}  // namespace understudy::mjcf
