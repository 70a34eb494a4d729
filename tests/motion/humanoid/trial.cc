#include "tests/motion/humanoid/trial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <spdlog/spdlog.h>

#include "assembly/make_world.h"
#include "robot/randomization.h"
#include "tests/motion/humanoid/fixture.h"

namespace understudy::motion {
namespace {

using Eigen::Vector3d;

constexpr double kEvery = 0.02;                       // s between two commands
constexpr double kSettle = 1.5;                       // s
constexpr double kRun = 60, kAcross = 24, kStop = 6;  // s
constexpr double kSegment = 5;                        // s of one wish, and between two pushes
constexpr double kFirstPush = 3, kPushTime = 0.1;     // s
constexpr double kAside = 2.0 / 3;                    // of a push ahead, that one aside has
constexpr double kSpeed = 0.3;                        // m/s, across other than flat ground
constexpr double kFallen = 0.6, kLow = 0.6;           // rad; of the standing height over its feet
constexpr double kStands = 0.2;                       // of the wishes: none
const Vector3d kLeast(-0.3, -0.25, -0.5), kMost(0.6, 0.25, 0.5);  // m/s, m/s, rad/s

const std::vector<TrialGround> kGrounds{
    {"rest", "stands on flat ground, a minute"},
    {"flat", "-0.3 to 0.6 m/s, ±0.25 m/s and ±0.5 rad/s at once, anew every 5 s, a minute"},
    {"slope", "5 degrees up and down, ahead with 0.3 m/s"},
    {"edges", "ten steps up or down of 2 cm, ahead with 0.3 m/s"},
    {"rough", "rough ground of difficulty 0.2, ahead with 0.3 m/s"},
};

bool OnFlat(const Trial& trial) { return trial.ground == "rest" || trial.ground == "flat"; }

config::Config TrialConfig(const Trial& trial, robot::Randomizer* randomizer) {
  std::string scene = "flat";
  double difficulty = 0;
  if (trial.ground == "slope") {
    scene = "slopes";
    difficulty = std::tan(5 * std::numbers::pi / 180) / 0.4;
  } else if (trial.ground == "edges") {
    scene = randomizer->Draw("up", "", 0, 1) < 0.5 ? "stairs_up" : "stairs_down";
    difficulty = (0.02 - 0.01) / 0.22;
  } else if (trial.ground == "rough") {
    scene = "rough";
    difficulty = 0.2;
  }
  const std::string seed = std::to_string(trial.seed);
  return ConfigOf(trial.robot,
                  {"scene=" + scene, "terrain.difficulty=" + std::to_string(difficulty),
                   "terrain.size=[14, 8]", "terrain.seed=" + seed,
                   "terrain.friction=" + std::to_string(randomizer->Draw("friction", "", 0.5, 1.2)),
                   "robot.dynamics.delay=0.005", "randomization.mass=[0.9, 1.1]",
                   "randomization.seed=" + seed, "sensors.seed=" + seed});
}

// What it is asked for, m/s, m/s, rad/s, at t s into the run.
class Client {
 public:
  Client(const Trial& trial, robot::Randomizer* randomizer) : ground_(trial.ground) {
    wishes_.fill(Vector3d::Zero());
    for (std::size_t i = 0; i < wishes_.size(); ++i) {
      if (randomizer->Draw("stands", std::to_string(i), 0, 1) < kStands) continue;
      for (int axis = 0; axis < 3; ++axis) {
        wishes_[i][axis] = randomizer->Draw("wish", std::to_string(i) + " " + std::to_string(axis),
                                            kLeast[axis], kMost[axis]);
      }
    }
  }

  Vector3d Wish(const MotionRig& rig, double t) const {
    if (ground_ == "rest") return {0, 0, 0};
    if (ground_ == "flat") return wishes_[static_cast<std::size_t>(t / kSegment)];
    const double yaw = -std::clamp(rig.world().robot().base().p_WB.y(), -0.5, 0.5);
    return {kSpeed, 0, std::clamp(1.5 * (yaw - rig.rpy().z()), -0.5, 0.5)};
  }

 private:
  std::string ground_;
  std::array<Vector3d, static_cast<std::size_t>(kRun / kSegment)> wishes_;
};

class Pusher {
 public:
  Pusher(const Trial& trial, robot::Randomizer* randomizer) : push_(trial.push) {
    for (std::size_t i = 0; i < at_.size(); ++i) {
      at_[i] = kFirstPush + kSegment * static_cast<double>(i) +
               randomizer->Draw("push", std::to_string(i), 0, 1);
      way_[i] = randomizer->Draw("way", std::to_string(i), 0, 2 * std::numbers::pi);
    }
  }

  void Step(double t, MotionRig* rig) {
    if (push_ <= 0 || pushed_ >= at_.size() || t < at_[pushed_]) return;
    const double way = way_[pushed_++];
    const double impulse = push_ * rig->world().robot().weight() / 9.81;
    const Vector3d push = Eigen::AngleAxisd(rig->rpy().z(), Vector3d::UnitZ()) *
                          Vector3d(impulse * std::cos(way), kAside * impulse * std::sin(way), 0);
    rig->Request("push", {{"body", rig->spec().crane_body},
                          {"impulse", {push.x(), push.y(), push.z()}},
                          {"for", kPushTime}});
  }

 private:
  double push_;  // N·s/kg
  std::array<double, static_cast<std::size_t>(kRun / kSegment)> at_{}, way_{};
  std::size_t pushed_ = 0;
};

}  // namespace

std::span<const TrialGround> HumanoidGrounds() { return kGrounds; }

double HumanoidPush(const std::string& ground) {
  return ground == "rest" || ground == "flat" ? 0.3 : 0;
}

Outcome TryHumanoid(const Trial& trial, const Watch& watch) {
  if (std::ranges::count(kGrounds, trial.ground, &TrialGround::name) == 0) {
    throw std::invalid_argument("no such ground: " + trial.ground);
  }
  robot::Randomizer randomizer(trial.seed);
  config::Config config = TrialConfig(trial, &randomizer);
  const Client client(trial, &randomizer);
  Pusher pusher(trial, &randomizer);
  for (const robot::Drawn& drawn : randomizer.draws().values) {
    spdlog::info("{} {}: {}", drawn.quantity, drawn.element, drawn.value);
  }
  physics::MujocoWorld world = assembly::MakePhysics(&config).world;
  HumanoidRig rig(config, std::move(world));
  rig.Start("standing");
  rig.Run(kSettle);
  const int state = rig.spec().motion.humanoid.balance.front();
  rig.SetFsm(state);
  bool fine = rig.Run(kSettle);
  const auto on_its_feet = [&] {
    return fine && rig.state().id == state && rig.tilt() < kFallen &&
           rig.state().body_height > kLow * rig.spec().standing.height;
  };

  const double start = rig.world().robot().base().p_WB.x();
  const double run = OnFlat(trial) ? kRun : kAcross;
  double t = 0;
  for (; t < run + kStop && on_its_feet(); t += kEvery) {
    const Vector3d wish = t < run ? client.Wish(rig, t) : Vector3d(0, 0, 0);
    rig.Ask(goal::Move{wish.x(), wish.y(), wish.z(), 1});
    if (t < run) pusher.Step(t, &rig);
    fine = rig.Run(kEvery);
    if (watch) watch(rig, t, wish);
  }
  Outcome outcome;
  if (!on_its_feet()) outcome.fell = t;
  const double made = rig.world().robot().base().p_WB.x() - start;
  outcome.got_there = OnFlat(trial) || made >= 0.5 * kSpeed * run;
  return outcome;
}

}  // namespace understudy::motion
