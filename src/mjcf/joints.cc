#include "mjcf/joints.h"

#include <charconv>
#include <cmath>

#include "base/errors.h"

namespace understudy::mjcf {
namespace {

void CollectBody(MjcfElement* body, std::string child_class, const MjcfDefaults& defaults,
                 MjcfJoints* joints) {
  if (const std::string* own = body->Find("childclass")) child_class = *own;
  for (MjcfElement& child : body->children) {
    if (child.name == "body") CollectBody(&child, child_class, defaults, joints);
    if (child.name != "joint") continue;
    MjcfJoint joint;
    joint.element = &child;
    joint.class_name = child.Find("class") != nullptr ? child.Get("class") : child_class;
    const auto find = [&](const char* attribute) {
      return defaults.Find(child, joint.class_name, kJointKinds, {attribute});
    };
    if (const auto type = find("type")) joint.type = type->value;
    if (joint.scalar()) {
      joint.range = FindRange(defaults, child, joint.class_name, kJointKinds, "range", "limited");
      joint.torque = FindRange(defaults, child, joint.class_name, kJointKinds, "actuatorfrcrange",
                               "actuatorfrclimited");
    }
    if (const std::string* name = child.Find("name")) joints->by_name[*name] = joints->all.size();
    joints->all.push_back(std::move(joint));
  }
}

}  // namespace

MjcfJoint* MjcfJoints::Find(const std::string& name) {
  const auto found = by_name.find(name);
  return found == by_name.end() ? nullptr : &all[found->second];
}

MjcfJoints CollectJoints(MjcfElement* root, const MjcfDefaults& defaults) {
  MjcfJoints joints;
  for (MjcfElement& section : root->children) {
    if (section.name == "worldbody") CollectBody(&section, "", defaults, &joints);
  }
  for (MjcfElement& section : root->children) {
    if (section.name != "actuator") continue;
    for (MjcfElement& actuator : section.children) {
      joints.actuators.push_back(&actuator);
      std::string target = actuator.Get("joint");
      if (target.empty()) target = actuator.Get("jointinparent");
      if (MjcfJoint* joint = joints.Find(target)) {
        joint->actuators.push_back(&actuator);
      } else {
        joints.other_actuators.push_back(&actuator);
      }
    }
  }
  return joints;
}

std::vector<double> ReadNumbers(const MjcfSetting& setting, const std::string& what,
                                std::size_t least) {
  std::vector<double> numbers;
  const char* at = setting.value.data();
  const char* const end = at + setting.value.size();
  const auto refuse = [&] {
    throw ModelError(setting.place.text() + ": " + what + "=\"" + setting.value + "\": expected " +
                     std::to_string(least) + (least == 1 ? " finite number" : " finite numbers"));
  };
  constexpr std::string_view kSpace = " \t\r\n";
  while (true) {
    while (at != end && kSpace.find(*at) != std::string_view::npos) ++at;
    if (at == end) break;
    if (*at == '+') ++at;
    double number = 0;
    const auto [rest, error] = std::from_chars(at, end, number);
    const bool whole = rest == end || kSpace.find(*rest) != std::string_view::npos;
    if (error != std::errc() || !whole || !std::isfinite(number)) refuse();
    numbers.push_back(number);
    at = rest;
  }
  if (numbers.size() < least) refuse();
  return numbers;
}

std::string NumbersText(std::span<const double> numbers) {
  std::string text;
  for (const double number : numbers) {
    std::array<char, 32> digits{};
    const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), number);
    if (!text.empty()) text += ' ';
    text.append(digits.data(), end);
  }
  return text;
}

std::optional<MjcfRange> FindRange(const MjcfDefaults& defaults, const MjcfElement& element,
                                   const std::string& class_name,
                                   std::span<const char* const> kinds, const char* range,
                                   const char* limited) {
  const auto word = defaults.Find(element, class_name, kinds, {limited});
  if (word && word->value == "false") return std::nullopt;
  const auto setting = defaults.Find(element, class_name, kinds, {range});
  if (!setting) return std::nullopt;
  const std::vector<double> numbers = ReadNumbers(*setting, range, 2);
  if (numbers.size() != 2 || !(numbers[0] < numbers[1])) {
    throw ModelError(setting->place.text() + ": " + range + "=\"" + setting->value +
                     "\": expected two ascending numbers");
  }
  return MjcfRange{numbers[0], numbers[1]};
}

}  // namespace understudy::mjcf
