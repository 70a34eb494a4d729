#include "config/validate_motors.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "base/nearest_word.h"
#include "config/keys.h"
#include "robot/hand_law.h"
#include "schema/archive.h"

namespace understudy::config {
namespace {

using schema::NumberText;

constexpr std::size_t kHandMotors = 16;  // ids of the mode byte of a hand

void CheckCurve(double knee_speed, double no_load_speed, const std::string& key,
                const Checker& checker) {
  checker.Check(knee_speed == 0 || knee_speed < no_load_speed, key + "knee_speed",
                "expected less than no_load_speed " + NumberText(no_load_speed) + " rad/s, got " +
                    NumberText(knee_speed));
}

void CheckMotorTypes(const std::vector<robot::MotorTypeSpec>& types, const Checker& checker) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < types.size(); ++i) {
    const robot::MotorTypeSpec& type = types[i];
    const std::string key = "robot.motor_types." + std::to_string(i) + ".";
    checker.Check(!type.name.empty(), key + "name", "expected a name");
    checker.Check(names.insert(type.name).second, key + "name",
                  "there is a '" + type.name + "' already");
    CheckCurve(type.knee_speed, type.no_load_speed, key, checker);
    checker.Check((type.winding_c_per_w > 0) == (type.casing_c_per_w > 0), key + "casing_c_per_w",
                  "expected winding_c_per_w and this both 0, or neither");
  }
}

// `list` is the key of the motors, `joints` the joints that already have a motor.
void CheckMotors(const std::vector<robot::MotorSpec>& motors,
                 const std::vector<robot::MotorTypeSpec>& types, const std::string& list,
                 std::set<std::string>* joints, const Checker& checker) {
  std::vector<std::string> names;
  for (const robot::MotorTypeSpec& type : types) names.push_back(type.name);
  for (std::size_t i = 0; i < motors.size(); ++i) {
    const robot::MotorSpec& m = motors[i];
    const std::string key = list + "." + std::to_string(i) + ".";
    checker.Check(!m.joint.empty(), key + "joint", "expected the name of a joint");
    checker.Check(joints->insert(m.joint).second, key + "joint",
                  "'" + m.joint + "' has a motor already");
    const bool known = m.type.empty() || std::ranges::find(names, m.type) != names.end();
    checker.Check(known, key + "type",
                  known           ? ""
                  : names.empty() ? "no motor type '" + m.type +
                                        "', nor any other: config/motors.yaml is missing"
                                  : "no motor type '" + m.type + "'" + DidYouMean(m.type, names));
    checker.Check(m.torque_limit > 0, key + "torque_limit", "expected more than 0 N·m");
    CheckCurve(m.knee_speed, m.no_load_speed, key, checker);
  }
}

void CheckSlots(const robot::RobotSpec& robot, const Checker& checker) {
  const int slots = SlotsOf(robot);
  int last = -1;
  checker.Check(!robot.motors.empty(), "robot.motors", "expected at least one motor");
  for (std::size_t i = 0; i < robot.motors.size(); ++i) {
    const int slot = robot.motors[i].slot;
    const std::string key = "robot.motors." + std::to_string(i) + ".slot";
    checker.Check(slot >= 0 && slot < slots, key,
                  "expected 0 to " + std::to_string(slots - 1) + " for this family, got " +
                      std::to_string(slot));
    checker.Check(slot > last, key,
                  "expected more than " + std::to_string(last) +
                      ", as slots ascend and no two are alike, got " + std::to_string(slot));
    last = slot;
  }
}

// Whether it may be part of a DDS topic's name: words between slashes, one of them a `*` where the
// law has several topics of the same form.
bool IsTopic(std::string topic, bool with_star) {
  const auto stars = std::ranges::count(topic, '*');
  if (stars != (with_star ? 1 : 0)) return false;
  std::ranges::replace(topic, '*', '_');
  const auto fits = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '/';
  };
  return !topic.empty() && topic.front() != '/' && topic.back() != '/' &&
         topic.find("//") == std::string::npos && std::all_of(topic.begin(), topic.end(), fits);
}

void CheckHand(const robot::HandSpec& hand, const std::vector<robot::MotorTypeSpec>& types,
               const std::string& key, std::set<std::string>* joints, const Checker& checker) {
  checker.Check(!hand.name.empty(), key + "name", "expected a name");
  const robot::HandLaw& law = robot::LawOf(hand);
  const bool registers = law.messages == robot::HandLaw::Messages::kRegisters;
  checker.Check(IsTopic(hand.topic, registers), key + "topic",
                "expected words of letters, digits and _ between slashes, as in " +
                    std::string(registers ? "inspire_hand/*/l with its *" : "dex3/left") +
                    ", got '" + hand.topic + "'");
  checker.Check(!registers || hand.touch.hz > 0, key + "touch.hz",
                "expected more than 0 Hz, as the law " + hand.law + " has messages of touch");
  checker.Check(!hand.motors.empty() && hand.motors.size() <= kHandMotors, key + "motors",
                "expected 1 to " + std::to_string(kHandMotors) + ", got " +
                    std::to_string(hand.motors.size()));
  CheckMotors(hand.motors, types, key + "motors", joints, checker);
  const int motors = static_cast<int>(hand.motors.size());
  checker.Check(hand.slots == 0 ? hand.slot == 0 : hand.slot + motors <= hand.slots, key + "slots",
                "expected room for " + std::to_string(motors) + " motors from slot " +
                    std::to_string(hand.slot) + " on, got " + std::to_string(hand.slots));
  checker.Check(hand.sdk_slot < 0 || hand.sdk_slot + motors <= robot::kHandSdkMotors,
                key + "sdk_slot",
                "expected room for " + std::to_string(motors) + " of the " +
                    std::to_string(robot::kHandSdkMotors) + " motors of rt/hand_sdk, got " +
                    std::to_string(hand.sdk_slot));
  if (law.follows == robot::HandLaw::Follows::kMotors) return;
  for (std::size_t i = 0; i < hand.motors.size(); ++i) {
    const robot::MotorSpec& motor = hand.motors[i];
    const std::string name = key + "motors." + std::to_string(i) + ".";
    const std::string why = ", as the law " + hand.law + " leads it by that";
    checker.Check(motor.span[0] != motor.span[1], name + "span", "expected two angles" + why);
    checker.Check(motor.hold_kp > 0, name + "hold_kp", "expected more than 0 N·m/rad" + why);
    checker.Check(motor.knee_speed > 0, name + "knee_speed", "expected more than 0 rad/s" + why);
  }
}

void CheckHands(const robot::RobotSpec& robot, std::set<std::string>* joints,
                const Checker& checker) {
  checker.Check(robot.hands.empty() || robot.family == robot::WireFamily::kHg, "robot.hands",
                "the go family has no messages for them");
  checker.Check(robot.hands.size() <= robot::kMostHands, "robot.hands",
                "expected at most " + std::to_string(robot::kMostHands) + ", got " +
                    std::to_string(robot.hands.size()));
  std::set<std::string> topics;
  for (std::size_t i = 0; i < robot.hands.size(); ++i) {
    const robot::HandSpec& hand = robot.hands[i];
    const std::string key = "robot.hands." + std::to_string(i) + ".";
    CheckHand(hand, robot.motor_types, key, joints, checker);
    checker.Check(topics.insert(hand.topic).second, key + "topic",
                  "another hand has '" + hand.topic + "' already");
  }
}

void CheckClamps(const robot::RobotSpec& robot, const Checker& checker) {
  for (std::size_t i = 0; i < robot.motors.size(); ++i) {
    const std::array<double, 2>& clamp = robot.motors[i].q_clamp;
    checker.Check(clamp[0] <= clamp[1], "robot.motors." + std::to_string(i) + ".q_clamp",
                  "expected least before most");
  }
}

void CheckParallel(const robot::RobotSpec& robot, const Checker& checker) {
  const int motors = static_cast<int>(robot.motors.size());
  std::set<int> taken;
  for (std::size_t i = 0; i < robot.parallel.size(); ++i) {
    const std::string pair = "robot.parallel." + std::to_string(i);
    const auto check = [&](int index, const std::string& key) {
      checker.Check(index >= 0 && index < motors, key,
                    "expected 0 to " + std::to_string(motors - 1) + ", as there are " +
                        std::to_string(motors) + " motors, got " + std::to_string(index));
      checker.Check(taken.insert(index).second, key,
                    "motor " + std::to_string(index) + " is in a pair already");
    };
    check(robot.parallel[i].pitch, pair + ".pitch");
    check(robot.parallel[i].roll, pair + ".roll");
    checker.Check(robot.parallel[i].roll_ratio > 0, pair + ".roll_ratio", "expected more than 0");
  }
}

}  // namespace

int SlotsOf(const robot::RobotSpec& robot) {
  return robot.family == robot::WireFamily::kGo ? 20 : 35;
}

void ValidateMotors(const robot::RobotSpec& robot, const Checker& checker) {
  std::set<std::string> joints;
  CheckSlots(robot, checker);
  CheckMotorTypes(robot.motor_types, checker);
  CheckMotors(robot.motors, robot.motor_types, "robot.motors", &joints, checker);
  CheckHands(robot, &joints, checker);
  CheckParallel(robot, checker);
  CheckClamps(robot, checker);
}

}  // namespace understudy::config
