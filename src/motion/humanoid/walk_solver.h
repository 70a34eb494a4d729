// Joint torques of a walking humanoid by inverse dynamics.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>

#include "motion/humanoid/walk_body.h"

namespace understudy::motion {

// What the body is to do now, world axes.
struct WalkTask {
  std::size_t stance = 0;                // the foot that rests and carries
  Eigen::Vector3d velocity{0, 0, 0};     // m/s, of the base: an estimate
  Eigen::Vector3d pressure{0, 0, 0};     // m, where the stance sole presses, from its centre
  Eigen::Vector3d other_at{0, 0, 0};     // m, where the other sole presses, from its centre
  Eigen::Vector3d other_force{0, 0, 0};  // N, of the ground on it
  double lift = 0;                       // m/s² upwards, of the centre of mass
  Eigen::Vector3d turn{0, 0, 0};         // rad/s², of the base
  Eigen::Vector3d foot_a{0, 0, 0};       // m/s², of the other sole's centre
  Eigen::Vector3d foot_turn{0, 0, 0};    // rad/s², of the other sole
};

// Solves one square system for the accelerations of base and legs and the force under the stance
// sole; the centre of mass moves ahead and aside as the pressure has it. Limits each replace a
// wish: what the sole can twist the ground with takes the base's yaw, what the stance hip can give
// its pitch and roll, a knee that gets straight the height of the centre of mass or of the other
// foot. Legs of five joints let their soles roll. Allocates only in the constructor.
class WalkSolver {
 public:
  explicit WalkSolver(const WalkBody& body);

  // The accelerations [rad/s²] that joints of neither leg will have, in motor order; 0 at first.
  std::span<double> known() { return known_; }

  // Computes the torques [N·m] of all joints, in motor order. `q`, `dq` as for WalkBody::Update.
  // Returns false, and leaves `tau` as it is, if the system has no solution.
  bool Solve(const WalkTask& task, std::span<const double> q, std::span<const double> dq,
             std::span<double> tau);

  double twist() const { return twist_; }  // N·m, of the stance sole, in the last solution

 private:
  static constexpr int kMost = 24;  // unknowns
  using Square =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMost, kMost>;
  using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMost, 1>;
  using Line = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, kMost>;
  using Row = Eigen::Ref<const Eigen::RowVectorXd>;

  int forces() const { return static_cast<int>(columns_.size()); }  // the first unknown force
  int ColumnOf(int motor) const;
  void Build(const WalkTask& task);
  void SetTorque(int row, int dof, double torque, const WalkTask& task);
  void Add(const Row& of, double wanted);
  void AddOtherFoot(const WalkTask& task);
  void KeepWithinLimits(const WalkTask& task, std::span<const double> q,
                        std::span<const double> dq);
  void LimitHip(int motor, int row, const WalkTask& task);
  void Replace(int row, int column, double value);
  void SolveAgain();
  void WriteTorques(const WalkTask& task, std::span<double> tau);

  const WalkBody& body_;
  std::vector<int> columns_;  // the model's rates that are unknown: the base's and the legs'
  std::vector<double> known_;
  Eigen::VectorXd accelerations_, torques_;  // of all of the model
  Eigen::RowVectorXd height_;                // of the centre of mass, by accelerations
  Square A_;
  Column b_, x_;
  Eigen::PartialPivLU<Square> lu_;
  int row_ = 0, height_row_ = 0, turn_row_ = 0, foot_row_ = 0;
  double twist_ = 0;
};

}  // namespace understudy::motion
