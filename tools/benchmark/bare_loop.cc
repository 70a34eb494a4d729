#include "bare_loop.h"

#include <algorithm>
#include <chrono>

#include <mujoco/mujoco.h>

#include "process.h"

namespace understudy::bench {

using Wall = std::chrono::steady_clock;

BareLoop::BareLoop(assembly::Simulation* run)
    : run_(run), model_(run->world().physics().model()), data_(mj_makeData(&model_)) {}

void BareLoop::Follow(std::int64_t from, std::int64_t to) {
  for (; step_ < from; ++step_) run_->Step();
  const mjData& now = run_->world().physics().data();
  const Eigen::Index nq = model_.nq, nv = model_.nv;
  const auto of = [nv](const mjtNum* values) {
    return Eigen::Map<const Eigen::VectorXd>(values, nv);
  };
  const Eigen::Index count = std::max<std::int64_t>(to - step_, 1);
  states_.resize(nq + 2 * nv, (count + kSecond - 1) / kSecond);
  forces_.resize(nv, count);
  for (Eigen::Index i = 0; i < count; ++i, ++step_) {
    if (i % kSecond == 0) {
      states_.col(i / kSecond) << Eigen::Map<const Eigen::VectorXd>(now.qpos, nq), of(now.qvel),
          of(now.qacc_warmstart);
    }
    run_->Step();
    // The torques of the motors, and what pulls and pushes at the bodies.
    forces_.col(i) = of(now.qfrc_smooth) - of(now.qfrc_passive) + of(now.qfrc_bias);
  }
  next_ = 0;
}

Speed BareLoop::Run(Bare what, double window) {
  const double cpu = ThreadCpu();
  const Wall::time_point start = Wall::now();
  double wall = 0;
  std::int64_t steps = 0;
  do {
    for (int i = 0; i < kTogether; ++i) Step(what);
    steps += kTogether;
    wall = std::chrono::duration<double>(Wall::now() - start).count();
  } while (wall < window);
  const auto count = static_cast<double>(steps);
  return {.wall = count / wall, .cpu = count / (ThreadCpu() - cpu)};
}

// Each second begins as in the run: a robot that walks by forces alone soon falls.
void BareLoop::Step(Bare what) {
  if (next_ % kSecond == 0) {
    const double* const state = states_.col(next_ / kSecond).data();
    std::copy_n(state, model_.nq, data_->qpos);
    std::copy_n(state + model_.nq, model_.nv, data_->qvel);
    std::copy_n(state + model_.nq + model_.nv, model_.nv, data_->qacc_warmstart);
  }
  std::copy_n(forces_.col(next_).data(), model_.nv, data_->qfrc_applied);
  mj_step(&model_, data_.get());
  if (what == Bare::kWithImu) mj_rnePostConstraint(&model_, data_.get());
  next_ = (next_ + 1) % forces_.cols();
}

}  // namespace understudy::bench
