// A quadruped under its motion service, and its ways up.
#pragma once

#include <cmath>

#include <Eigen/Geometry>

#include "tests/motion/rig.h"

namespace understudy::motion {

// error_code of the vendor's sport service page.
enum : int {
  kStanding = 100,
  kDamped = 1001,
  kLocked = 1002,
  kCrouch = 1004,
  kGesture = 1006,
  kSit = 1007,
  kBalance = 1013,
  kPose = 1091,
};

class QuadrupedRig : public MotionRig {
 public:
  using MotionRig::MotionRig;
  // One of config/robots with the settings ("KEY=VALUE") given.
  explicit QuadrupedRig(const std::string& robot, const std::vector<std::string>& settings = {},
                        const std::filesystem::path& scene = FlatScene())
      : MotionRig(ConfigOf(robot, settings), scene) {}

  // As MotionRig's, but what lies stays lying, damped.
  void Start(std::string_view pose) {
    MotionRig::Start(pose);
    if (pose == "lying") Ask(goal::Damp{});
  }
  // In the stand that Stand Up leads to, and on to a balanced one.
  void StandUp() {
    Start("lying");
    Run(0.2);
    Ask(goal::StandUp{});
    Run(3);
  }
  void BalanceStand() {
    StandUp();
    Ask(goal::BalanceStand{});
    Run(2);
  }
};

// A robot that is told again and again how to move, as a client does.
class WalkingRig : public QuadrupedRig {
 public:
  using QuadrupedRig::QuadrupedRig;

  void Walk(const Eigen::Vector3d& wish, double seconds) {
    for (double t = 0; t < seconds - 1e-9; t += kEvery) {
      Ask(goal::Move{wish.x(), wish.y(), wish.z(), 1});
      Run(kEvery);
    }
  }

  // Mean of the base's velocity in its own heading, m/s and rad/s.
  Eigen::Vector3d Speed(const Eigen::Vector3d& wish, double seconds) {
    Eigen::Vector3d way(0, 0, 0);
    for (double t = 0; t < seconds - 1e-9; t += kEvery) {
      const Eigen::Vector3d from = world().robot().base().p_WB;
      const double yaw = rpy().z();
      Walk(wish, kEvery);
      const double turn = std::remainder(rpy().z() - yaw, 2 * M_PI);
      const Eigen::Vector3d moved = Eigen::AngleAxisd(-yaw - turn / 2, Eigen::Vector3d::UnitZ()) *
                                    (world().robot().base().p_WB - from);
      way += Eigen::Vector3d(moved.x(), moved.y(), turn);
    }
    return way / seconds;
  }

  // Runs until it has stood still for a while; false when it does not within `seconds`.
  bool ComesToRest(double seconds) {
    double still = 0;
    for (double t = 0; t < seconds && still < 0.3; t += kEvery) {
      Run(kEvery);
      still = fastest() < 0.3 ? still + kEvery : 0;
    }
    return still >= 0.3;
  }

  static constexpr double kEvery = 0.02;  // s
};

}  // namespace understudy::motion
