#include "estimate.h"

#include <cmath>
#include <utility>

#include "assembly/simulation.h"
#include "config/data_dir.h"
#include "config/load.h"

namespace understudy::bench {
namespace {

constexpr double kSettleTime = 2, kStand = 10;  // s
constexpr double kPush = 0.1, kRecover = 2;     // s
constexpr double kSpeed = 0.33;                 // m/s

// Sums of squares.
struct Error {
  double velocity = 0, height = 0;
  long steps = 0;
};

Error Watch(assembly::Simulation* alone, double seconds, Error error = {}) {
  const long steps = std::lround(seconds / alone->world().physics().timestep());
  for (long i = 0; i < steps; ++i) {
    alone->Step();
    const robot::RobotState& said = alone->world().robot(0).sampled();
    error.velocity += (said.motion->v_WB_W - said.base.v_WB_W).squaredNorm();
    error.height += std::pow(said.motion->body_height - said.base.p_WB.z(), 2);
  }
  error.steps += steps;
  return error;
}

}  // namespace

std::vector<Figure> MeasureEstimate(const std::string& robot) {
  const config::Config config = config::LoadConfig(
      {.robot = robot, .files = {}, .sets = {"start.pose=standing"}}, config::DataDir());
  if (!robot::IsQuadruped(config.robots[0].spec.kind)) return {};
  assembly::Simulation alone(config);
  Watch(&alone, kSettleTime);
  const Error standing = Watch(&alone, kStand);
  Error pushed;
  const physics::MujocoWorld& physics = alone.world().physics();
  const double impulse =
      kSpeed * physics.SubtreeMass(physics.FindBody(config.robots[0].spec.base_body));
  for (const auto& [x, y] :
       {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)}) {
    alone.Request("push", {{"impulse", {impulse * x, impulse * y, 0}}, {"for", kPush}});
    pushed = Watch(&alone, kPush + kRecover, pushed);
  }
  std::vector<Figure> figures;
  const auto add = [&](const char* how, const Error& error) {
    const auto rms = [&](double sum) { return std::sqrt(sum / static_cast<double>(error.steps)); };
    figures.push_back({.robot = robot,
                       .name = std::string("estimate of velocity, ") + how + ", rms error",
                       .unit = "m/s",
                       .value = rms(error.velocity)});
    figures.push_back({.robot = robot,
                       .name = std::string("estimate of height, ") + how + ", rms error",
                       .unit = "m",
                       .value = rms(error.height)});
  };
  add("standing", standing);
  add("pushed", pushed);
  return figures;
}

}  // namespace understudy::bench
