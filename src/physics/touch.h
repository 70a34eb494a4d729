// What presses on a robot's hands and their pads.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "mjcf/mujoco_handles.h"
#include "robot/robot_spec.h"

namespace understudy::physics {

// Spreads the contacts of links with pads over the pads' cells. A contact is a point; skin and
// sensor spread it, by a bell of TouchSpec::spread around the point (*assumed*). A pad feels what
// pushes into its skin, no deeper and no higher than kReach from it. Allocates in the constructor.
class Touch {
 public:
  Touch() = default;
  // In `model` the names of `spec` begin with `prefix`. Pads whose site it lacks feel nothing.
  Touch(const mjModel& model, const robot::RobotSpec& spec, const std::string& prefix);

  // Computes what each cell feels [N], by hand, pad, row and column: of a contact that sits on the
  // cell's middle all of it. `cells` has one number for each.
  void Read(const mjModel& model, const mjData& data, std::span<float> cells) const;
  // Computes the sum of the normal forces [N] on the links of each hand, in the order of
  // robot::HandNames: those with pads, and the link that bears a motor's with all that hangs on it.
  void Forces(const mjModel& model, const mjData& data, std::span<double> hands) const;

  static constexpr double kReach = 0.008;  // m, *assumed*
  static constexpr int kMostRows = 16;     // and columns

 private:
  struct Pad {
    int site = 0, body = 0;
    std::size_t first = 0;  // its first cell
    int rows = 0, columns = 0;
    double spread = 0;  // m
  };

  // Adds the links that belong to the joint of a hand's motor.
  void AddLinks(const mjModel& model, int joint, int base, int hand);

  int HandOf(int body) const {
    return hand_of_body_.empty() ? -1 : hand_of_body_[static_cast<std::size_t>(body)];
  }

  std::vector<Pad> pads_;
  std::vector<int> hand_of_body_;  // -1: no hand's; empty: there are no hands
};

}  // namespace understudy::physics
