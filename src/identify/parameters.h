// What can be fitted of a robot, and where its figures are in the robot's description.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "identify/replay.h"
#include "physics/bench.h"
#include "robot/robot_spec.h"

namespace understudy::identify {

// A kind of figure. One row is all that there is to know of it.
struct FigureKind {
  std::string_view name;  // as --parameters has it, and the key of the robot's YAML
  std::string_view unit;
  double least = 0, most = 0;  // within which it is looked for
  bool ratio = true;           // errors of it count by its value, and it is above 0
  double tell = 0;             // the largest standard error, of 1 or of its value, that tells it
  bool usual = false;          // fitted unless told otherwise
  std::string_view excite;     // what would tell it
  // Where it is: in dynamics.fitted, or else in the motors; neither: it is the delay or the mass.
  double robot::FittedDynamicsSpec::*fitted = nullptr;
  double robot::MotorSpec::*motor = nullptr;
};

std::span<const FigureKind> FigureKinds();

// Joints that share their figures: a row of robot.dynamics.fitted, or one joint.
struct Group {
  std::string name{};
  std::vector<std::size_t> motors{};
};

// A figure to be fitted.
struct Parameter {
  const FigureKind* quantity = nullptr;
  std::size_t group = kAll;
  double before = 0;
  std::vector<std::size_t> limbs{};  // that it can move; empty: all

  static constexpr std::size_t kAll = ~std::size_t{0};
};

// A robot's description with a row of dynamics.fitted for every group, and nothing else of joints:
// rows have what the model has where the description has none.
struct Basis {
  robot::RobotSpec spec{};
  std::vector<Group> groups{};
  std::vector<physics::BodyFigures> links{};  // in motor order

  // Groups are the rows that there are, and each joint without a row; with `by_joint` each joint.
  // Where joints of a row differ, the row has their mean.
  Basis(const robot::RobotSpec& robot, const physics::Bench& bench, bool by_joint);

  // The parameters of these names; none: the usual ones. Throws ConfigError for an unknown one.
  std::vector<Parameter> Parameters(const std::vector<std::string>& names,
                                    const physics::Bench& bench) const;
  std::string NameOf(const Parameter& parameter) const;  // "armature hip"
  Figures With(std::span<const Parameter> parameters, std::span<const double> values) const;
};

}  // namespace understudy::identify
