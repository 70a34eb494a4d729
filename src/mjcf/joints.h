// Collects the joints and actuators of a model, with default classes applied.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mjcf/defaults.h"
#include "mjcf/document.h"

namespace understudy::mjcf {

using MjcfRange = std::array<double, 2>;

struct MjcfJoint {
  MjcfElement* element = nullptr;
  std::string class_name;
  std::string type = "hinge";
  std::optional<MjcfRange> range;       // as written, in degrees if <compiler> says so
  std::optional<MjcfRange> torque;      // actuatorfrcrange [N·m or N] if limited
  std::vector<MjcfElement*> actuators;  // that act only on this joint

  bool scalar() const { return type == "hinge" || type == "slide"; }
};

// All joints and actuators. Valid while no element of the tree is added or removed.
struct MjcfJoints {
  std::vector<MjcfJoint> all;
  std::map<std::string, std::size_t> by_name;  // index in `all`
  std::vector<MjcfElement*> other_actuators;   // that act through a tendon, site, slider or body
  std::vector<MjcfElement*> actuators;         // all, in the order of the file

  MjcfJoint* Find(const std::string& name);
};

// Throws ModelError with file and line if a range is not two ascending finite numbers.
MjcfJoints CollectJoints(MjcfElement* root, const MjcfDefaults& defaults);

// Elements that set defaults for joints and for actuators.
inline constexpr std::array<const char*, 1> kJointKinds = {"joint"};
inline constexpr std::array<const char*, 9> kActuatorKinds = {
    "general", "motor",    "position", "velocity", "intvelocity",
    "damper",  "cylinder", "muscle",   "adhesion"};

// Parses the numbers of an attribute. Throws ModelError with the place and `what` if there are
// fewer than `least` or one is not finite.
std::vector<double> ReadNumbers(const MjcfSetting& setting, const std::string& what,
                                std::size_t least);
// Returns the shortest text that reads back as the same numbers.
std::string NumbersText(std::span<const double> numbers);

// A range attribute that holds: limited by its word, or by being there where the word is "auto" or
// missing. Throws ModelError when it is not two ascending finite numbers.
std::optional<MjcfRange> FindRange(const MjcfDefaults& defaults, const MjcfElement& element,
                                   const std::string& class_name,
                                   std::span<const char* const> kinds, const char* range,
                                   const char* limited);

}  // namespace understudy::mjcf
