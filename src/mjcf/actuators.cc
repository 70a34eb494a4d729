#include "mjcf/actuators.h"

#include <algorithm>

#include "base/errors.h"

namespace understudy::mjcf {
namespace {

std::string NameOf(const MjcfElement& element) {
  const std::string name = element.Get("name");
  return "<" + element.name + ">" + (name.empty() ? " without a name" : " '" + name + "'");
}

double GearOf(const MjcfElement& actuator, const MjcfDefaults& defaults) {
  const auto gear = defaults.Find(actuator, actuator.Get("class"), kActuatorKinds, {"gear"});
  return gear ? ReadNumbers(*gear, "gear", 1)[0] : 1.0;
}

// Whether an actuator without a joint could act on this one.
bool MayDrive(const MjcfElement& actuator, const std::string& joint, const MjcfElement& root) {
  const std::string tendon = actuator.Get("tendon");
  if (tendon.empty()) return true;
  for (const MjcfElement& section : root.children) {
    if (section.name != "tendon") continue;
    for (const MjcfElement& element : section.children) {
      if (element.Get("name") != tendon || element.name != "fixed") continue;
      return std::any_of(element.children.begin(), element.children.end(),
                         [&](const MjcfElement& child) { return child.Get("joint") == joint; });
    }
  }
  return true;
}

void RefuseSharedJoint(const MjcfJoint& joint, const MjcfJoints& joints, const MjcfElement& root) {
  const std::string name = joint.element->Get("name");
  std::vector<const MjcfElement*> drivers(joint.actuators.begin(), joint.actuators.end());
  for (const MjcfElement* other : joints.other_actuators) {
    if (MayDrive(*other, name, root)) drivers.push_back(other);
  }
  if (drivers.size() < 2 && joint.actuators.size() == drivers.size()) return;
  std::string who;
  for (const MjcfElement* driver : drivers) {
    who += (who.empty() ? "" : " and ") + NameOf(*driver) + " (" + driver->place.text() + ")";
  }
  throw ModelError(joint.element->place.text() + ": joint '" + name +
                   "' has actuatorfrcrange and is driven by " + who +
                   "; MuJoCo 2.2.2 can limit such a joint only if a single actuator drives it, "
                   "and by joint=. Leave out the range or use MuJoCo 3");
}

// Returns the forcerange for which gear times force stays within `torque`.
MjcfRange ForceRange(const MjcfJoint& joint, const MjcfElement& actuator,
                     const MjcfDefaults& defaults) {
  const double gear = GearOf(actuator, defaults);
  if (gear == 0) {
    throw ModelError(actuator.place.text() + ": " + NameOf(actuator) +
                     " has gear 0, so the actuatorfrcrange of its joint cannot limit it");
  }
  MjcfRange force = {(*joint.torque)[0] / gear, (*joint.torque)[1] / gear};
  if (gear < 0) std::swap(force[0], force[1]);
  const auto own = FindRange(defaults, actuator, actuator.Get("class"), kActuatorKinds,
                             "forcerange", "forcelimited");
  if (!own) return force;
  const MjcfRange both = {std::max(force[0], (*own)[0]), std::min(force[1], (*own)[1])};
  if (!(both[0] < both[1])) {
    throw ModelError(actuator.place.text() + ": forcerange of " + NameOf(actuator) +
                     " and actuatorfrcrange of its joint have no force in common");
  }
  return both;
}

void DropLimits(MjcfElement* element) {
  if (element->name == "joint") {
    element->Drop("actuatorfrcrange");
    element->Drop("actuatorfrclimited");
  }
  for (MjcfElement& child : element->children) DropLimits(&child);
}

}  // namespace

void LimitActuators(MjcfElement* root, const MjcfDefaults& defaults, MjcfJoints* joints,
                    std::vector<Rewrite>* rewrites) {
  for (const MjcfJoint& joint : joints->all) {
    const auto says = [&](const char* attribute) {
      return defaults.Find(*joint.element, joint.class_name, kJointKinds, {attribute}).has_value();
    };
    if (!says("actuatorfrcrange") && !says("actuatorfrclimited")) continue;
    const std::string of = " of joint '" + joint.element->Get("name") + "'";
    const MjcfPlace& place = joint.element->place;
    if (!joint.torque) {
      rewrites->push_back({place, "actuatorfrcrange" + of + " left out",
                           "it does not limit: not a hinge or slide, or actuatorfrclimited=false"});
      continue;
    }
    RefuseSharedJoint(joint, *joints, *root);
    const std::string what = "actuatorfrcrange " + NumbersText(*joint.torque) + of;
    if (joint.actuators.empty()) {
      rewrites->push_back({place, what + " left out", "no actuator drives it"});
      continue;
    }
    MjcfElement& actuator = *joint.actuators.front();
    const std::string range = NumbersText(ForceRange(joint, actuator, defaults));
    actuator.Set("forcelimited", "true");
    actuator.Set("forcerange", range);
    rewrites->push_back({place, what + " became forcerange " + range + " of " + NameOf(actuator),
                         "MuJoCo 2.2.2 limits actuators, not joints"});
  }
  DropLimits(root);
}

void RenameTorqueSensors(MjcfElement* root, const MjcfDefaults& defaults, MjcfJoints* joints,
                         std::vector<Rewrite>* rewrites) {
  for (MjcfElement& section : root->children) {
    if (section.name != "sensor") continue;
    for (MjcfElement& sensor : section.children) {
      if (sensor.name != "jointactuatorfrc") continue;
      const std::string joint_name = sensor.Get("joint");
      const MjcfJoint* joint = joints->Find(joint_name);
      if (joint == nullptr) {
        throw ModelError(sensor.place.text() + ": no joint '" + joint_name + "'");
      }
      sensor.Drop("joint");
      const std::string what = "sensor jointactuatorfrc of joint '" + joint_name + "' became ";
      if (joint->actuators.size() == 1 && GearOf(*joint->actuators.front(), defaults) == 1) {
        MjcfElement& actuator = *joint->actuators.front();
        if (actuator.Find("name") == nullptr) actuator.Set("name", "understudy_" + joint_name);
        sensor.name = "actuatorfrc";
        sensor.Set("actuator", actuator.Get("name"));
        rewrites->push_back({sensor.place, what + "actuatorfrc of " + NameOf(actuator),
                             "new in MuJoCo 3; the same number where the gear is 1"});
      } else {
        sensor.name = "user";
        sensor.Set("objtype", "joint");
        sensor.Set("objname", joint_name);
        sensor.Set("datatype", "real");
        sensor.Set("needstage", "acc");
        sensor.Set("dim", "1");
        rewrites->push_back({sensor.place, what + "a user sensor that reads 0",
                             "no single actuator of gear 1 drives the joint"});
      }
    }
  }
}

}  // namespace understudy::mjcf
