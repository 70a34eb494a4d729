#include "config/validate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "authority/onboard.h"
#include "base/nearest_word.h"
#include "config/keys.h"
#include "config/randomization_keys.h"
#include "config/validate_robot.h"
#include "objects/object_kinds.h"
#include "robot/command_topics.h"
#include "robot/fault_bank.h"
#include "schema/archive.h"
#include "services/api_names.h"
#include "wire/robot_topics.h"

namespace understudy::config {
namespace {

using schema::NumberText;

void CheckRandomization(const Config& config, const Checker& checker) {
  const robot::RandomizationSpec& spec = config.randomization;
  for (const RandomRange& range : RandomRanges()) {
    const robot::RandomizationSpec::Limits& limits = spec.*range.limits;
    const std::string key = "randomization." + std::string(range.name);
    checker.Check(limits.empty() || limits.size() == 2, key,
                  "expected [least, most], or [] to draw nothing, got " +
                      std::to_string(limits.size()) + " numbers");
    checker.Check(limits.empty() || limits[0] <= limits[1], key,
                  "expected least before most, got " + NumberText(limits.empty() ? 0 : limits[0]) +
                      " before " + NumberText(limits.empty() ? 0 : limits[1]));
  }
  const robot::RateSpec& rates = config.robots[0].spec.rates;
  checker.Check(spec.timestep.empty() || !robot::PossibleTimesteps(spec.timestep, rates).empty(),
                "randomization.timestep",
                "no step in it divides the periods of " + NumberText(rates.lowstate_hz) + " and " +
                    NumberText(rates.service_hz) + " Hz, as 0.001, 0.0005 and 0.00025 s may");
}

bool IsWhole(double ratio) {
  const double whole = std::round(ratio);
  return whole >= 1 && std::abs(ratio - whole) < 1e-9 * whole;
}

void CheckRates(const Config& config, const Checker& checker) {
  const robot::RateSpec& rates = config.robots[0].spec.rates;
  const double steps = 1 / config.physics.timestep;
  checker.Check(IsWhole(steps / rates.lowstate_hz), "robot.rates.lowstate_hz",
                "expected a rate whose period is a whole number of physics steps of " +
                    NumberText(config.physics.timestep) + " s, got " +
                    NumberText(rates.lowstate_hz));
  const auto divides = [&](double rate, const std::string& key) {
    checker.Check(IsWhole(rates.lowstate_hz / rate), key,
                  "expected a rate that divides lowstate_hz " + NumberText(rates.lowstate_hz) +
                      ", got " + NumberText(rate));
  };
  checker.Check(rates.motion_hz <= steps, "robot.rates.motion_hz",
                "expected at most one message per physics step, " + NumberText(steps) +
                    " Hz, got " + NumberText(rates.motion_hz));
  checker.Check(IsWhole(steps / rates.service_hz), "robot.rates.service_hz",
                "expected a rate whose period is a whole number of physics steps, got " +
                    NumberText(rates.service_hz));
  const std::vector<robot::HandSpec>& hands = config.robots[0].spec.hands;
  for (std::size_t i = 0; i < hands.size(); ++i) {
    divides(hands[i].hz, "robot.hands." + std::to_string(i) + ".hz");
    if (hands[i].touch.hz > 0)
      divides(hands[i].touch.hz, "robot.hands." + std::to_string(i) + ".touch.hz");
  }
  divides(rates.lf_hz, "robot.rates.lf_hz");
}

void CheckMotionService(const Config& config, const Checker& checker) {
  const std::string& wanted = config.robots[0].motion.service;
  std::vector<std::string> words = authority::MotionServices(config.robots[0].spec);
  words.emplace_back(authority::kNoService);
  const bool known = wanted.empty() || std::find(words.begin(), words.end(), wanted) != words.end();
  checker.Check(known, "motion.service",
                "firmware '" + config.robots[0].spec.firmware + "' has no motion service '" +
                    wanted + "'" + DidYouMean(wanted, words));
  const std::string& pose = config.robots[0].start.pose;
  const bool falls = config.robots[0].spec.kind == robot::RobotKind::kHumanoid &&
                     wanted == authority::kNoService &&
                     (pose.empty() ? config.robots[0].spec.default_start : pose) == "standing";
  checker.Check(!falls, "start.pose",
                "a standing humanoid falls while no motion service balances it; start it hanging "
                "(lower it with `understudy ctl crane lower`) or clamped (`ctl clamp off`)");
}

// What the robot has not, or never has, is refused here as the running robot would.
void CheckFaults(const Config& config, const Checker& checker) {
  const RobotConfig& robot = config.robots[0];
  if (robot.faults.empty()) return;
  std::vector<std::string> topics = robot::CommandTopicNames(robot.spec);
  const std::vector<std::string> services = services::ServiceNames(robot.spec.apis);
  for (const wire::RobotTopic& topic : wire::PublishedTopics(robot.spec, services))
    topics.push_back(topic.name);
  robot::FaultBank bank(robot.spec, topics, services, robot.sensors.seed);
  for (std::size_t i = 0; i < robot.faults.size(); ++i) {
    const auto planned = bank.Plan(robot.faults[i]);
    checker.Check(planned.ok(), "faults." + std::to_string(i), planned.why());
  }
}

void CheckPicture(const objects::ObjectSpec& object, const std::string& key,
                  const Checker& checker) {
  const bool is_poster = objects::KindOf(object).print.pattern == objects::Pattern::kPicture;
  checker.Check(object.image.empty() || is_poster, key + ".image",
                "a " + object.kind + " shows no picture; expected none");
}

// `key` is that of the object.
void CheckWalk(const objects::ObjectSpec& object, const std::string& key, const Checker& checker) {
  constexpr double kShortest = 0.01;  // m
  if (!objects::Walks(object)) {
    const objects::ObjectSpec none;
    for (const auto& [name, is_set] :
         {std::pair{".speed", object.speed != 0}, std::pair{".wait", object.wait != 0},
          std::pair{".then", object.then != none.then}, std::pair{".seed", object.seed != 0}}) {
      checker.Check(!is_set, key + name, "is of a path, and this object has none; expected path");
    }
    return;
  }
  checker.Check(object.path.size() <= objects::kMostCorners, key + ".path",
                "expected at most " + std::to_string(objects::kMostCorners) + ", got " +
                    std::to_string(object.path.size()));
  checker.Check(objects::SpeedOf(object) > 0, key + ".path",
                "a " + object.kind + " has no speed of its own; expected speed beside it");
  checker.Check(object.mass == 0, key + ".mass", "nothing moves what walks; expected 0");
  checker.Check(object.yaw == 0, key + ".yaw", "what walks looks where it goes; expected 0");
  std::array<double, 2> at{object.pos[0], object.pos[1]};
  const auto is_at = [&at](const std::array<double, 2>& to) {
    return std::hypot(to[0] - at[0], to[1] - at[1]) < kShortest;
  };
  for (std::size_t i = 0; i < object.path.size(); ++i) {
    const std::array<double, 2>& to = object.path[i].to;
    checker.Check(!is_at(to), key + ".path." + std::to_string(i) + ".to",
                  "it is there already; expected another place");
    at = to;
  }
  checker.Check(object.then != objects::PathEnd::kRound || !is_at({object.pos[0], object.pos[1]}),
                key + ".path", "round goes back to pos by itself; expected another last corner");
}

void CheckObjects(const Config& config, const Checker& checker) {
  constexpr std::string_view kLetters =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  constexpr std::size_t kLongest = 40;
  const std::vector<objects::ObjectSpec>& list = config.objects;
  checker.Check(list.size() <= objects::kMostObjects, "objects",
                "expected at most " + std::to_string(objects::kMostObjects) + ", got " +
                    std::to_string(list.size()));
  const std::vector<std::string> names = objects::NamesOf(list);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string key = "objects." + std::to_string(i);
    const std::string& name = list[i].name;
    checker.Check(
        name.size() <= kLongest && name.find_first_not_of(kLetters) == std::string::npos,
        key + ".name",
        "expected at most 40 letters, digits, _ and -, got '" + schema::OneLine(name) + "'");
    const auto other = std::ranges::find(names, names[i]) - names.begin();
    checker.Check(static_cast<std::size_t>(other) == i, key + ".name",
                  "'" + names[i] + "' is that of objects." + std::to_string(other) + " too");
    checker.Check(list[i].mass == 0 || !objects::IsFixed(list[i]), key + ".mass",
                  "a " + list[i].kind + " is fixed to the world; expected 0");
    const bool is_tag = objects::KindOf(list[i]).print.pattern == objects::Pattern::kAprilTag;
    checker.Check(list[i].id == 0 || is_tag, key + ".id",
                  "a " + list[i].kind + " shows no AprilTag; expected 0");
    CheckPicture(list[i], key, checker);
    CheckWalk(list[i], key, checker);
  }
}

}  // namespace

void ValidateTerrain(const Config& config, const Places& places) {
  constexpr double kShortest = 2;  // m
  const Checker checker(places);
  const terrain::TerrainSpec& terrain = config.terrain;
  checker.Check(config.scene != terrain::kPatchesScene || !terrain.patches.empty(), "scene",
                "'row' needs terrain.patches, as in [{kind: rough}, {kind: gaps}]");
  checker.Check(terrain.patches.empty() || places.empty() || places.contains("scene"),
                "terrain.patches", "nothing asks for them; set scene to row");
  for (std::size_t i = 0; i < terrain.patches.size(); ++i) {
    const double length = terrain.patches[i].length;
    checker.Check(length == 0 || length >= kShortest,
                  "terrain.patches." + std::to_string(i) + ".length",
                  "expected 0 or at least 2 m, got " + NumberText(length));
  }
}

void Validate(const Config& config, const Places& places) {
  ValidateTerrain(config, places);
  const Checker checker(places);
  ValidateRobot(config.robots[0].spec, checker);
  CheckObjects(config, checker);
  CheckRates(config, checker);
  CheckRandomization(config, checker);
  CheckMotionService(config, checker);
  CheckFaults(config, checker);
  if (!config.robots[0].start.pose.empty())
    CheckStartPose(config.robots[0].start.pose, "start.pose", checker);
  checker.Check(config.robots[0].network.domain >= 0 && config.robots[0].network.domain <= 232,
                "network.domain", "expected 0 to 232");
}

}  // namespace understudy::config
