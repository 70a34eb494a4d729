// What presses on the pads of a robot's hands.
#pragma once

#include <cstddef>
#include <span>
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
  // `spec` has the names of `model`. Pads whose site the model lacks feel nothing.
  Touch(const mjModel& model, const robot::RobotSpec& spec);

  // Computes what each cell feels [N], by hand, pad, row and column: of a contact that sits on the
  // cell's middle all of it. `cells` has one number for each.
  void Read(const mjModel& model, const mjData& data, std::span<float> cells) const;
  // Computes the sum of the normal forces [N] on the links with pads of each hand, in spec order;
  // 0 for hands without.
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

  int HandOf(int body) const {
    return hand_of_body_.empty() ? -1 : hand_of_body_[static_cast<std::size_t>(body)];
  }

  std::vector<Pad> pads_;
  std::vector<int> hand_of_body_;  // -1: no link with pads; empty: there are none
};

}  // namespace understudy::physics
