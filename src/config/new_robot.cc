#include "config/new_robot.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <utility>

#include "base/nearest_word.h"
#include "base/printed.h"
#include "mjcf/document.h"
#include "physics/stature.h"
#include "schema/yaml_document.h"

namespace understudy::config {
namespace {

using schema::OneLine;

constexpr std::size_t kNear = 3;  // names that are offered for a motor without a joint

// Words of URDF files for what the vendor calls otherwise, longer ones first.
constexpr std::array<std::pair<const char*, const char*>, 18> kWords = {{
    {"frontright", "fr"},
    {"rightfront", "fr"},
    {"frontleft", "fl"},
    {"leftfront", "fl"},
    {"rearright", "rr"},
    {"righthind", "rr"},
    {"hindright", "rr"},
    {"rearleft", "rl"},
    {"lefthind", "rl"},
    {"hindleft", "rl"},
    {"upperleg", "thigh"},
    {"lowerleg", "calf"},
    {"abduction", "hip"},
    {"haa", "hip"},
    {"hfe", "thigh"},
    {"kfe", "calf"},
    {"wheel", "foot"},  // the vendor's URDFs of Go2-W and B2-W call their wheels feet
    {"joint", ""},
}};

constexpr double kHangs = 0.2;  // m over the ground, as the vendor's robots hang here

// The robot's file. What stands between is of the motors, and so on.
constexpr char kRobotHead[] =
    R"(# @name, made by `understudy new` of @urdf.
# What is not here is as with @like; with `understudy run FILE --print-config` one sees it, and
# `understudy run @like --help-config` explains every key. Figures are the URDF's, or those of @like.
extends: @like
robot:
  name: @name
  description: @name, like @like
  model: @name.xml  # beside this file
  base_body: @base  # has the free joint
  crane_body: @crane
)";
constexpr char kNoRevisions[] =
    R"(  mode_machine: @mode_machine
  revision: ""
  revisions: {@none}  # has none of them
)";
constexpr char kNoHands[] = R"(  hand_make: none
  hand_makes: []  # it lacks the links on which hands of @like sit: name hands that fit it
)";
constexpr char kNoCameras[] =
    R"(  cameras: []  # it lacks links that bear those of @like: describe its own
)";
constexpr char kRobotRest[] = R"(
  # By the motor's name in @like: its joint, limits in N m and rad/s. Slot: its place in LowCmd.
  # knee_speed: up to which there is the whole torque; the same share of no_load_speed as there.
  motors:
@motors
  # The model has its sites at the origins of links: move them to where the units are.
  imu: {site: @site, secondary_site: @second_site}

  # The geoms that stand on the ground, and the direction in which a foot's sensor feels.
@feet
  # rad, one angle per motor, in the order above; m from the ground to the base.
@poses)";
constexpr char kStandHeight[] = R"(
  # How high it stands, m, when its motion service has it stand up:
  # motion: {quadruped: {stand_height: @stand_height}}
)";

constexpr char kStandsUp[] =
    R"(# What it does at first. docs/reference/scenarios.md has what else one can ask for.
scenario: @name stands up
robot: @file
start: lying
duration: 6
script:
  - {at: 0.5, service.call: {service: sport, api: 1004}}  # StandUp
expect:
  - {never: base.tilt > 30 deg, name: stays upright}
  - {settles: base.speed < 0.1, within: 5, name: comes to rest}
  - {final: base.height between @low and @high, name: stands}
)";
constexpr char kHangsThere[] =
    R"(# What it does at first. docs/reference/scenarios.md has what else one can ask for.
scenario: @name hangs from its crane
robot: @file
start: hanging
duration: 6
expect:
  - {never: base.tilt > 30 deg, name: stays upright}
  - {settles: base.speed < 0.1, within: 6, name: comes to rest}
)";

// A word of a text, and what stands for it.
using Words = std::vector<std::pair<std::string, std::string>>;

// What was put in is not looked at again.
std::string Filled(const std::string& text, const Words& words) {
  std::string filled;
  for (std::size_t at = 0; at < text.size();) {
    const Words::value_type* longest = nullptr;
    for (const Words::value_type& word : words) {
      if (text.compare(at, word.first.size(), word.first) != 0) continue;
      if (longest == nullptr || word.first.size() > longest->first.size()) longest = &word;
    }
    filled += longest == nullptr ? text.substr(at, 1) : longest->second;
    at += longest == nullptr ? 1 : longest->first.size();
  }
  return filled;
}

// A name without what differs from one file to the next: "Front_Right-HAA" becomes "frhip".
std::string Plain(const std::string& name) {
  std::string plain;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) continue;
    plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  for (const auto& [word, same] : kWords) {
    const std::size_t at = plain.find(word);
    if (at != std::string::npos) plain.replace(at, std::string(word).size(), same);
  }
  return plain;
}

std::string Number(double number) { return Printed("%.5g", number == 0 ? 0.0 : number); }

// A name as YAML: in quotes where it could be taken for something else.
std::string Quoted(const std::string& name) {
  const bool is_plain = !name.empty() && std::ranges::all_of(name, [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '.' || c == '/';
  });
  if (is_plain && std::isdigit(static_cast<unsigned char>(name[0])) == 0) return name;
  std::string quoted = "'";
  for (const char c : name) quoted += c == '\'' ? std::string("''") : std::string(1, c);
  return quoted + "'";
}

std::string Side(const std::string& name) { return name.substr(0, name.find('_')); }

// The joints that stand in for the motors on the side of a foot.
std::vector<std::string> JointsOfFoot(const NewRobot& robot, const std::string& foot) {
  std::vector<std::string> joints;
  for (const MotorMatch& match : robot.motors) {
    if (Side(match.motor) == Side(foot) && !match.joint.empty()) joints.push_back(match.joint);
  }
  return joints;
}

const mjcf::UrdfReadJoint* Find(const NewRobot& robot, const std::string& joint) {
  const auto found = std::ranges::find(robot.robot.joints, joint, &mjcf::UrdfReadJoint::name);
  return found == robot.robot.joints.end() ? nullptr : &*found;
}

// One line per motor: what is the URDF's. The rest is that of the motor of the same name.
std::string MotorLine(const NewRobot& robot, const MotorMatch& match,
                      const robot::MotorSpec& like) {
  std::string line = "    " + Quoted(match.motor) + ": {joint: ";
  const mjcf::UrdfReadJoint* joint = Find(robot, match.joint);
  if (joint == nullptr) {
    line +=
        match.motor + "}  # slot " + std::to_string(like.slot) + ": MISSING; which joint is it?";
    for (const std::string& near : match.near) line += " " + near;
    return line + "\n";
  }
  line += Quoted(match.joint);
  if (joint->effort > 0) line += ", torque_limit: " + Number(joint->effort);
  if (joint->velocity > 0 && like.no_load_speed > 0) {
    line += ", knee_speed: " +
            Number(joint->velocity * std::min(1.0, like.knee_speed / like.no_load_speed)) +
            ", no_load_speed: " + Number(joint->velocity);
  }
  return line + "}  # slot " + std::to_string(like.slot) + "\n";
}

std::string FeetText(const NewRobot& robot, const robot::RobotSpec& like, const mjModel& model) {
  if (like.feet.empty()) return "  feet: []\n";
  std::string text = "  feet:\n";
  for (const robot::FootSpec& foot : like.feet) {
    std::string geoms;
    for (const std::string& geom : physics::SoleGeoms(model, JointsOfFoot(robot, foot.name))) {
      geoms += (geoms.empty() ? "" : ", ") + Quoted(geom);
    }
    text += "    - {name: " + Quoted(foot.name) + ", geoms: [" + geoms + "], axis: [" +
            Number(foot.axis.x()) + ", " + Number(foot.axis.y()) + ", " + Number(foot.axis.z()) +
            "]}" + (geoms.empty() ? "  # MISSING: name its colliding geoms" : "") + "\n";
  }
  return text;
}

// A pose with the angles of `like`, within the ranges of the joints. `above` [m] is how high its
// lowest point is over the ground.
// Of a motor in a pose of the other robot, within the range of its joint.
double AngleOf(const NewRobot& robot, const robot::PoseSpec& like, std::size_t motor) {
  const mjcf::UrdfReadJoint* joint = Find(robot, robot.motors[motor].joint);
  if (joint == nullptr || !joint->range) return like.q[motor];
  return std::clamp(like.q[motor], (*joint->range)[0], (*joint->range)[1]);
}

// Of the base over the ground, m; 0 of one that is fixed.
double HeightOf(const NewRobot& robot, const mjModel& model, const robot::PoseSpec& like) {
  if (robot.robot.fixed) return 0;
  std::vector<physics::JointAngle> joints;
  for (std::size_t i = 0; i < robot.motors.size(); ++i) {
    const mjcf::UrdfReadJoint* joint = Find(robot, robot.motors[i].joint);
    if (joint != nullptr) joints.push_back({joint->name, AngleOf(robot, like, i)});
  }
  return physics::HeightOnGround(model, robot.robot.base, like.quat, joints);
}

// The body from which it hangs: as the other robot, by its base or by another link of that name.
std::string CraneText(const NewRobot& robot, const robot::RobotSpec& like) {
  if (like.crane_body == like.base_body)
    return Quoted(robot.robot.base) + "  # from which it hangs";
  if (std::ranges::count(robot.robot.bodies, like.crane_body) > 0) {
    return Quoted(like.crane_body) + "  # from which it hangs, as " + robot.like + " does";
  }
  return Quoted(robot.robot.base) + "  # from which it hangs: it has no " + Quoted(like.crane_body);
}

bool BearsCameras(const NewRobot& robot, const robot::RobotSpec& like) {
  return std::ranges::all_of(like.cameras, [&](const robot::CameraSpec& camera) {
    return camera.body.empty() || std::ranges::count(robot.robot.bodies, camera.body) > 0;
  });
}

std::string PoseText(const NewRobot& robot, const mjModel& model, const std::string& name,
                     const robot::PoseSpec& like, double above) {
  std::string angles;
  for (std::size_t i = 0; i < robot.motors.size(); ++i) {
    angles += (i == 0 ? "" : i % 12 == 0 ? ",\n        " : ", ") + Number(AngleOf(robot, like, i));
  }
  const double height = robot.robot.fixed ? 0 : above + HeightOf(robot, model, like);
  return "  " + name + ":\n    q: [" + angles + "]\n    height: " + Number(height) + "\n";
}

mjcf::MjcfElement* FindBody(mjcf::MjcfElement* element, const std::string& name) {
  if (element->name == "body" && element->Get("name") == name) return element;
  for (mjcf::MjcfElement& child : element->children) {
    if (mjcf::MjcfElement* found = FindBody(&child, name)) return found;
  }
  return nullptr;
}

// The first bodies with "imu" in their name: fixed to the base, and elsewhere.
struct Units {
  mjcf::MjcfElement* fixed = nullptr;
  mjcf::MjcfElement* moved = nullptr;
};

void FindUnits(mjcf::MjcfElement* body, bool fixed, Units* units) {
  mjcf::MjcfElement*& found = fixed ? units->fixed : units->moved;
  if (found == nullptr && Plain(body->Get("name")).find("imu") != std::string::npos) found = body;
  for (mjcf::MjcfElement& child : body->children) {
    const bool moves = std::ranges::find(child.children, "joint", &mjcf::MjcfElement::name) !=
                       child.children.end();
    if (child.name == "body") FindUnits(&child, fixed && !moves, units);
  }
}

}  // namespace

std::vector<MotorMatch> MatchMotors(const robot::RobotSpec& like,
                                    const std::vector<mjcf::UrdfReadJoint>& joints) {
  std::vector<std::string> left;
  for (const mjcf::UrdfReadJoint& joint : joints) left.push_back(joint.name);
  std::vector<MotorMatch> matches;
  for (const robot::MotorSpec& motor : like.motors) {
    matches.push_back({.motor = motor.joint, .slot = motor.slot, .joint = {}, .near = {}});
    if (std::erase(left, motor.joint) > 0) matches.back().joint = motor.joint;
  }
  for (MotorMatch& match : matches) {
    if (!match.joint.empty()) continue;
    const auto same = [&](const std::string& name) { return Plain(name) == Plain(match.motor); };
    if (std::ranges::count_if(left, same) != 1) continue;
    match.joint = *std::ranges::find_if(left, same);
    std::erase(left, match.joint);
  }
  for (MotorMatch& match : matches) {
    if (!match.joint.empty()) continue;
    std::vector<std::string> others = left;
    for (std::string near; match.near.size() < kNear; std::erase(others, near)) {
      near = NearestWord(match.motor, others);
      if (near.empty()) break;
      match.near.push_back(near);
    }
  }
  return matches;
}

std::array<std::string, 2> AddImuSites(const robot::RobotSpec& like, mjcf::UrdfRobot* robot) {
  mjcf::MjcfElement* const base = FindBody(&robot->model, robot->base);
  Units units;
  FindUnits(base, true, &units);
  mjcf::MjcfElement* const main = units.fixed != nullptr   ? units.fixed
                                  : units.moved != nullptr ? units.moved
                                                           : base;
  mjcf::MjcfElement* const second =
      like.imu.secondary_site.empty() || units.moved == main ? nullptr : units.moved;
  std::array<std::string, 2> bodies{main->Get("name"),
                                    second == nullptr ? "" : second->Get("name")};
  // By name, since a site moves the bodies beside it.
  std::vector<std::pair<std::string, std::string>> sites{{bodies[0], like.imu.site}};
  if (second != nullptr) sites.emplace_back(bodies[1], like.imu.secondary_site);
  for (const auto& [body, name] : sites) {
    mjcf::MjcfElement* const in = FindBody(&robot->model, body);
    mjcf::MjcfElement site{"site", {}, {}, in->place};
    site.Set("name", name);
    in->children.insert(in->children.begin(), std::move(site));
  }
  return bodies;
}

bool HasWrists(const mjcf::UrdfRobot& robot, const std::vector<std::filesystem::path>& hands) {
  for (const std::filesystem::path& hand : hands) {
    for (const mjcf::MjcfElement& section : mjcf::ReadMjcf(hand).children) {
      if (section.name != "worldbody") continue;
      for (const mjcf::MjcfElement& wrist : section.children) {
        if (std::ranges::count(robot.bodies, wrist.Get("name")) == 0) return false;
      }
    }
  }
  return true;
}

std::string NewRobotYaml(const NewRobot& robot, const robot::RobotSpec& like, const mjModel& model,
                         const std::vector<std::string>& revisions) {
  std::string none;
  for (const std::string& revision : revisions) {
    none += (none.empty() ? "\"" : ", \"") + revision + "\": ";
  }
  std::string motors;
  for (std::size_t i = 0; i < robot.motors.size(); ++i) {
    motors += MotorLine(robot, robot.motors[i], like.motors[i]);
  }
  const Words words = {
      {"@name", robot.name},
      {"@urdf", OneLine(robot.urdf)},
      {"@like", Quoted(robot.like)},
      {"@base", Quoted(robot.robot.base)},
      {"@crane", CraneText(robot, like)},
      {"@mode_machine", std::to_string(like.mode_machine)},
      {"@none", none},
      {"@motors", motors},
      {"@site", Quoted(like.imu.site)},
      {"@second_site", robot.two_units ? Quoted(like.imu.secondary_site) : "\"\""},
      {"@feet", FeetText(robot, like, model)},
      {"@poses", PoseText(robot, model, "lying", like.lying, 0) +
                     PoseText(robot, model, "standing", like.standing, 0) +
                     PoseText(robot, model, "hanging", like.hanging, kHangs)},
      {"@stand_height", Number(like.motion.quadruped.stand_height)},
  };
  return Filled(kRobotHead, words) + (revisions.empty() ? "" : Filled(kNoRevisions, words)) +
         (like.hand_makes.empty() || robot.keeps_hands ? "" : Filled(kNoHands, words)) +
         (BearsCameras(robot, like) ? "" : Filled(kNoCameras, words)) + Filled(kRobotRest, words) +
         (robot::IsQuadruped(like.kind) ? Filled(kStandHeight, words) : "");
}

std::string NewScenarioYaml(const NewRobot& robot, const robot::RobotSpec& like,
                            const mjModel& model, const std::string& file) {
  // About the pose, since a motion service stands as high as it likes; lying is far below.
  const double height = HeightOf(robot, model, like.standing);
  return Filled(robot::IsQuadruped(like.kind) ? kStandsUp : kHangsThere,
                {{"@name", robot.name},
                 {"@file", Quoted(file)},
                 {"@low", Number(0.7 * height)},
                 {"@high", Number(1.4 * height)}});
}

}  // namespace understudy::config
