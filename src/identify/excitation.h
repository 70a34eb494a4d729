// Excitation signals for identification: chirps within the joints' limits.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::identify {

struct ExcitationSpec {
  std::vector<std::size_t> motors{};  // in motor order; empty: all of the body
  double amplitude = 0.3;             // rad at most, either way
  double from_hz = 0.2, to_hz = 6;    // of the chirps
  double seconds = 20;                // of the chirps, their ramps included
  double kp = 20, kd = 1;             // N·m/rad, N·m·s/rad
};

// Commands over time: a move from where the joints are to the pose in which the robot hangs, chirps
// about it, and damping that comes softly. Each joint has its own phase, so that no two move alike.
// Amplitudes come and go within a second, shrink where they would ask for more than kMostSpeed, and
// leave kMargin of a joint's range at either side.
class Excitation {
 public:
  static constexpr double kMove = 3, kRamp = 1, kSoften = 1.5;  // s; *assumed*, as the next two
  static constexpr double kMostSpeed = 4;                       // rad/s of a commanded angle
  static constexpr double kMargin = 0.1;                        // rad

  // `q` are the angles [rad] from which it begins, `ranges` those of the joints [rad], in motor
  // order.
  Excitation(const robot::RobotSpec& robot, const ExcitationSpec& spec, std::span<const double> q,
             std::span<const std::array<double, 2>> ranges);

  // Returns the command at `t` [s] since the begin. With `stopped` from 0 to `t`, the ending began
  // then: the joints are held where they were to be, and damping comes.
  robot::RobotCommand At(double t, double stopped = -1) const;
  double seconds() const { return kMove + spec_.seconds + kSoften; }

 private:
  struct Joint {
    double begin = 0, centre = 0;  // rad
    double amplitude = 0, phase = 0;
  };

  double Angle(const Joint& joint, double t) const;

  ExcitationSpec spec_;
  std::vector<Joint> joints_;
};

}  // namespace understudy::identify
