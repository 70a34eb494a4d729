#include "motion/humanoid/walk_solver.h"

#include <algorithm>
#include <cmath>

namespace understudy::motion {
namespace {

// All assumed, tried on every robot here.
constexpr double kRestDamping = 20;   // 1/s, of the stance sole
constexpr double kMostTwist = 0.035;  // m: the sole's moment about the vertical, over its load
constexpr double kHipShare = 0.95;    // of a hip's torque limit: the rest is for its friction
constexpr double kLeastBend = 0.2;    // rad, of a knee
constexpr double kBendStiffness = 600, kBendDamping = 40;  // 1/s², 1/s, of a knee at that
constexpr double kMostBend = 400;                          // rad/s², of a knee

}  // namespace

WalkSolver::WalkSolver(const WalkBody& body)
    : body_(body),
      known_(body.motors()),
      accelerations_(Eigen::VectorXd::Zero(body.bias().size())),
      torques_(body.bias().size()),
      height_(body.bias().size()) {
  for (int i = 0; i < 6; ++i) columns_.push_back(body.base_dof() + i);
  for (const WalkBody::Foot& foot : body.feet()) {
    for (const int motor : foot.motors)
      columns_.push_back(body.dof(static_cast<std::size_t>(motor)));
  }
  const int unknowns = forces() + (body_.rolls() ? 5 : 4);
  if (!body.can_walk()) return;
  A_.resize(unknowns, unknowns);
  b_.resize(unknowns);
  x_.setZero(unknowns);
  lu_ = Eigen::PartialPivLU<Square>(unknowns);
}

int WalkSolver::ColumnOf(int motor) const {
  const auto found = std::ranges::find(columns_, body_.dof(static_cast<std::size_t>(motor)));
  return static_cast<int>(found - columns_.begin());
}

bool WalkSolver::Solve(const WalkTask& task, std::span<const double> q, std::span<const double> dq,
                       std::span<double> tau) {
  Build(task);
  SolveAgain();
  KeepWithinLimits(task, q, dq);
  if (!x_.allFinite()) return false;
  WriteTorques(task, tau);
  return true;
}

void WalkSolver::Build(const WalkTask& task) {
  const WalkBody::Foot& stance = body_.feet()[task.stance];
  A_.setZero();
  row_ = 0;
  for (; row_ < 6; ++row_) SetTorque(row_, body_.base_dof() + row_, 0, task);
  for (int i = 0; i < 3; ++i) {
    Add(stance.J.row(i), -stance.a0[i] - kRestDamping * (task.velocity + stance.v)[i]);
  }
  for (int i = 0; i < 3; ++i) Add(stance.J.row(3 + i), -stance.dw0[i] - kRestDamping * stance.w[i]);

  height_row_ = row_;
  const int up = body_.base_dof() + 2;
  height_ = body_.M().row(up) / body_.mass();
  Add(height_, task.lift - body_.bias()[up] / body_.mass() + body_.gravity());

  turn_row_ = row_;
  const Eigen::Vector3d turn = body_.R_WB().transpose() * task.turn;
  for (int i = 0; i < 3; ++i) Replace(row_++, 3 + i, turn[i]);
  AddOtherFoot(task);
}

// The row says that a joint gives that torque [N·m]; the base's give none.
void WalkSolver::SetTorque(int row, int dof, double torque, const WalkTask& task) {
  const WalkBody::Foot& stance = body_.feet()[task.stance];
  const WalkBody::Foot& other = body_.feet()[1 - task.stance];
  double known = body_.bias()[dof] - torque;
  for (std::size_t i = 0; i < known_.size(); ++i) {
    known += body_.M()(dof, body_.dof(i)) * known_[i];
  }
  for (int k = 0; k < forces(); ++k)
    A_(row, k) = body_.M()(dof, columns_[static_cast<std::size_t>(k)]);
  const Eigen::Vector3d way = stance.J.block<3, 1>(0, dof), turn = stance.J.block<3, 1>(3, dof);
  A_.block<1, 3>(row, forces()) = -(way + turn.cross(task.pressure)).transpose();
  A_(row, forces() + 3) = -turn.z();
  if (body_.rolls()) A_(row, forces() + 4) = -turn.dot(stance.R.col(0));
  const Eigen::Vector3d other_way =
      other.J.block<3, 1>(0, dof) + other.J.block<3, 1>(3, dof).cross(task.other_at);
  b_[row] = other_way.dot(task.other_force) - known;
}

void WalkSolver::Add(const Row& of, double wanted) {
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    A_(row_, static_cast<int>(k)) = of[columns_[k]];
  }
  for (std::size_t i = 0; i < known_.size(); ++i) wanted -= of[body_.dof(i)] * known_[i];
  b_[row_++] = wanted;
}

void WalkSolver::AddOtherFoot(const WalkTask& task) {
  const WalkBody::Foot& foot = body_.feet()[1 - task.stance];
  for (int i = 0; i < 3; ++i) {
    foot_row_ = row_;
    Add(foot.J.row(i), task.foot_a[i] - foot.a0[i]);
  }
  if (!body_.rolls()) {
    for (int i = 0; i < 3; ++i) Add(foot.J.row(3 + i), task.foot_turn[i] - foot.dw0[i]);
    return;
  }
  const Eigen::Vector3d left = foot.R.col(1), wanted = task.foot_turn - foot.dw0;
  height_ = left.transpose() * foot.J.bottomRows<3>();
  Add(height_, left.dot(wanted));
  Add(foot.J.row(5), wanted.z());
}

void WalkSolver::KeepWithinLimits(const WalkTask& task, std::span<const double> q,
                                  std::span<const double> dq) {
  bool again = false;
  for (std::size_t i = 0; i < 2; ++i) {
    const WalkBody::Foot& foot = body_.feet()[i];
    const auto knee = static_cast<std::size_t>(foot.knee);
    const int column = ColumnOf(foot.knee);
    const double least =
        kBendStiffness * (kLeastBend - foot.bend * q[knee]) - kBendDamping * foot.bend * dq[knee];
    if (foot.bend * x_[column] >= least) continue;
    Replace(i == task.stance ? height_row_ : foot_row_, column,
            foot.bend * std::clamp(least, -kMostBend, kMostBend));
    again = true;
  }
  if (again) SolveAgain();
  const double weight = body_.mass() * body_.gravity();
  const double most = kMostTwist * std::max(0.0, weight - task.other_force.z());
  const int twist = forces() + 3;
  if (std::abs(x_[twist]) > most) {
    Replace(turn_row_ + 2, twist, std::copysign(most, x_[twist]));
    SolveAgain();
  }
  const WalkBody::Foot& stance = body_.feet()[task.stance];
  LimitHip(stance.hip_pitch, turn_row_ + 1, task);
  LimitHip(stance.hip_roll, turn_row_, task);
}

// A hip that gives less than the solution needs would tip the sole: the base turns in its place.
void WalkSolver::LimitHip(int motor, int row, const WalkTask& task) {
  if (motor < 0) return;
  const auto hip = static_cast<std::size_t>(motor);
  const Line of = A_.row(row);
  const double wanted = b_[row], most = kHipShare * body_.limit(hip);
  SetTorque(row, body_.dof(hip), 0, task);
  const double torque = A_.row(row).dot(x_) - b_[row];
  if (std::abs(torque) > most) {
    b_[row] += std::copysign(most, torque);
    SolveAgain();
  } else {
    A_.row(row) = of;
    b_[row] = wanted;
  }
}

void WalkSolver::SolveAgain() {
  lu_.compute(A_);
  x_ = lu_.solve(b_);
}

void WalkSolver::Replace(int row, int column, double value) {
  A_.row(row).setZero();
  A_(row, column) = 1;
  b_[row] = value;
}

void WalkSolver::WriteTorques(const WalkTask& task, std::span<double> tau) {
  const WalkBody::Foot& stance = body_.feet()[task.stance];
  const WalkBody::Foot& other = body_.feet()[1 - task.stance];
  for (std::size_t i = 0; i < known_.size(); ++i) accelerations_[body_.dof(i)] = known_[i];
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    accelerations_[columns_[k]] = x_[static_cast<int>(k)];
  }
  const Eigen::Vector3d force = x_.segment<3>(forces());
  Eigen::Vector3d moment = task.pressure.cross(force);
  twist_ = x_[forces() + 3];
  moment.z() += twist_;
  if (body_.rolls()) moment += x_[forces() + 4] * stance.R.col(0);
  torques_ = body_.bias();
  torques_.noalias() += body_.M() * accelerations_;
  const Eigen::Vector3d other_moment = task.other_at.cross(task.other_force);
  for (std::size_t i = 0; i < tau.size(); ++i) {
    const int dof = body_.dof(i);
    tau[i] = torques_[dof] - stance.J.col(dof).head<3>().dot(force) -
             stance.J.col(dof).tail<3>().dot(moment) -
             other.J.col(dof).head<3>().dot(task.other_force) -
             other.J.col(dof).tail<3>().dot(other_moment);
  }
}

}  // namespace understudy::motion
