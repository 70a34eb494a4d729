#include "tests/motion/quadruped/trial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <mujoco/mujoco.h>
#include <spdlog/spdlog.h>

#include "assembly/make_world.h"
#include "authority/onboard.h"
#include "config/data_dir.h"
#include "config/load.h"
#include "robot/randomization.h"

namespace understudy::motion {
namespace {

using Eigen::Vector3d;

constexpr int kBalance = 1013, kInGait = 100;
constexpr double kEvery = 0.02;                 // s between two commands
constexpr double kSettle = 1;                   // s
constexpr double kRun = 12, kSegment = 2;       // s; of one wish on flat ground
constexpr std::array<double, 2> kPushes{3, 7};  // s, and up to one more
constexpr double kPushTime = 0.1;               // s
constexpr double kStop = 6;                     // s
constexpr double kStill = 0.3, kRest = 0.3;     // rad/s of its joints, s: it has come to rest
constexpr double kLie = 1, kPatience = 30;      // s before and of a recovery

const std::vector<TrialGround> kGrounds{
    {"rest", "stands on flat ground"},
    {"flat", "each axis asked for every other time, anywhere in its range, anew every 2 s"},
    {"rough", "rough ground of difficulty 0.3, ahead with 0.3 to 1 m/s, weaving"},
    {"slope", "5 to 15 degrees up or down, ahead with 0.3 to 1 m/s"},
    {"stairs", "ten steps up or down of 8 cm (B2, A2 12), ahead with 0.3 to 0.5 m/s"},
};

bool Wheeled(const robot::RobotSpec& spec) { return spec.kind == robot::RobotKind::kWheeled; }
bool Tall(const robot::RobotSpec& spec) { return spec.motion.quadruped.stand_height > 0.4; }

// What somebody asks of it who looks on.
class Client {
 public:
  Client(const Trial& trial, const robot::RobotSpec& spec, robot::Randomizer* randomizer)
      : ground_(trial.ground), walk_(spec.motion.quadruped.walk) {
    const bool stairs = ground_ == "stairs";
    speed_ = randomizer->Draw("speed", "", 0.3, stairs ? 0.5 : 1);
    weave_ = ground_ == "rough" ? randomizer->Draw("weave", "", -0.4, 0.4) : 0;
    wishes_.fill(Vector3d::Zero());
    for (std::size_t i = 0; i < wishes_.size(); ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        const std::string element = std::to_string(i) + " " + std::to_string(axis);
        if (randomizer->Draw("asks", element, 0, 1) < 0.5) continue;
        wishes_[i][axis] =
            randomizer->Draw("wish", element, walk_.least_speed[axis], walk_.most_speed[axis]);
      }
    }
  }

  // m/s, m/s, rad/s at t s into the run.
  Vector3d Wish(const MotionRig& rig, double t) const {
    if (ground_ == "rest") return {0, 0, 0};
    if (ground_ == "flat") {
      return wishes_[std::min(static_cast<std::size_t>(t / kSegment), wishes_.size() - 1)];
    }
    const double yaw =
        weave_ * std::sin(t) - std::clamp(rig.world().robot().base().p_WB.y(), -0.5, 0.5);
    return {speed_, 0, std::clamp(1.5 * (yaw - rig.rpy().z()), -0.8, 0.8)};
  }

  // m along x that it is asked to get in all.
  double way() const { return ground_ == "rest" || ground_ == "flat" ? 0 : kRun * speed_; }

 private:
  std::string ground_;
  const robot::WalkSpec& walk_;
  double speed_ = 0, weave_ = 0;
  std::array<Vector3d, static_cast<std::size_t>(kRun / kSegment)> wishes_;
};

std::vector<std::string> SceneOf(const Trial& trial, const robot::RobotSpec& spec,
                                 robot::Randomizer* randomizer) {
  const auto scene = [](const std::string& kind, double difficulty) {
    return std::vector<std::string>{"scene=" + kind,
                                    "terrain.difficulty=" + std::to_string(difficulty)};
  };
  if (trial.ground == "rough") return scene("rough", 0.3);
  if (trial.ground == "slope") {
    const double angle = randomizer->Draw("angle", "", 5, 15) * std::numbers::pi / 180;
    return scene("slopes", std::tan(angle) / 0.4);
  }
  if (trial.ground == "stairs") {
    const double rise = !Wheeled(spec) && Tall(spec) ? 0.12 : 0.08;
    const bool up = randomizer->Draw("up", "", 0, 1) < 0.5;
    return scene(up ? "stairs_up" : "stairs_down", (rise - 0.01) / 0.22);
  }
  return scene("flat", 0);
}

config::Config ConfigOf(const Trial& trial, robot::Randomizer* randomizer) {
  const auto load = [&](const std::vector<std::string>& sets) {
    return config::LoadConfig({.robot = trial.robot, .files = {}, .sets = sets}, config::DataDir());
  };
  std::vector<std::string> sets = SceneOf(trial, load({}).robots[0].spec, randomizer);
  const std::string seed = std::to_string(trial.seed);
  for (const std::string& set :
       {std::string("start.pose=standing"), std::string("robot.dynamics.delay=0.01"),
        std::string("randomization.mass=[0.8, 1.2]"), "randomization.seed=" + seed,
        "terrain.seed=" + seed, "sensors.seed=" + seed, std::string("terrain.size=[14, 8]"),
        "terrain.friction=" + std::to_string(randomizer->Draw("friction", "", 0.4, 1.2))}) {
    sets.push_back(set);
  }
  if (!trial.policy.empty()) {
    const config::RobotConfig robot = load(sets).robots[0];
    const std::string service =
        "robot.services." +
        authority::MotionService(robot.spec, authority::StartService(robot.spec, robot.motion))
            .name;
    sets.push_back(service + ".controller=policy");
    sets.push_back(service + ".policy=" + std::filesystem::absolute(trial.policy).string());
  }
  return load(sets);
}

bool TrunkTouches(const MotionRig& rig) {
  const mjModel& model = rig.world().model();
  const mjData& data = rig.world().data();
  const int base = mj_name2id(&model, mjOBJ_BODY, rig.spec().base_body.c_str());
  for (int i = 0; i < data.ncon; ++i) {
    if (model.geom_bodyid[data.contact[i].geom1] == base ||
        model.geom_bodyid[data.contact[i].geom2] == base) {
      return true;
    }
  }
  return false;
}

bool OnItsFeet(const MotionRig& rig) {
  const int id = rig.state().id;
  return id == kBalance || id == kInGait;
}

void Right(MotionRig* rig, Outcome* outcome) {
  rig->Run(kLie);
  rig->Ask(goal::RecoveryStand{});
  outcome->righted =
      rig->RunUntil(kInGait, kPatience) && rig->Run(kLie) && OnItsFeet(*rig) && !TrunkTouches(*rig);
}

}  // namespace

std::span<const TrialGround> TrialGrounds() { return kGrounds; }

double PushOf(const robot::RobotSpec& spec) { return Wheeled(spec) ? 0.6 : Tall(spec) ? 0.9 : 1; }

Outcome Try(const Trial& trial, const Watch& watch) {
  if (std::ranges::count(kGrounds, trial.ground, &TrialGround::name) == 0) {
    throw std::invalid_argument("no such ground: " + trial.ground);
  }
  robot::Randomizer randomizer(trial.seed);
  config::Config config = ConfigOf(trial, &randomizer);
  const Client client(trial, config.robots[0].spec, &randomizer);
  std::array<double, kPushes.size()> push_at{}, push_way{};
  for (std::size_t i = 0; i < kPushes.size(); ++i) {
    push_at[i] = kPushes[i] + randomizer.Draw("push", std::to_string(i), 0, 1);
    push_way[i] = randomizer.Draw("way", std::to_string(i), 0, 2 * std::numbers::pi);
  }
  for (const robot::Drawn& drawn : randomizer.draws().values) {
    spdlog::info("{} {}: {}", drawn.quantity, drawn.element, drawn.value);
  }
  physics::MujocoWorld world = assembly::MakePhysics(&config).world;
  MotionRig rig(config, std::move(world));
  const double impulse = trial.push * rig.world().robot().weight() / 9.81;

  Outcome outcome;
  bool fine = rig.Run(kSettle);
  const double start = rig.world().robot().base().p_WB.x();
  double t = 0, still = 0;
  std::size_t pushed = 0;
  for (; t < kRun + kStop && fine && OnItsFeet(rig); t += kEvery) {
    const bool stops = t >= kRun;
    still = rig.fastest() < kStill ? still + kEvery : 0;
    if (stops && still > kRest) break;
    const Vector3d wish = stops ? Vector3d(0, 0, 0) : client.Wish(rig, t);
    rig.Ask(goal::Move{wish.x(), wish.y(), wish.z(), 1});
    if (pushed < kPushes.size() && t >= push_at[pushed] && trial.push > 0) {
      const double way = push_way[pushed++];
      rig.Request("push", {{"body", config.robots[0].spec.crane_body},
                           {"impulse", {impulse * std::cos(way), impulse * std::sin(way), 0}},
                           {"for", kPushTime}});
    }
    fine = rig.Run(kEvery);
    if (watch) watch(rig, t, wish);
  }
  const double made = rig.world().robot().base().p_WB.x() - start;
  outcome.got_there = client.way() == 0 || made >= 0.5 * client.way();
  fine = fine && still > kRest && rig.Run(kSettle) && OnItsFeet(rig);
  if (fine && !TrunkTouches(rig)) return outcome;
  outcome.fell = t;
  Right(&rig, &outcome);
  return outcome;
}

}  // namespace understudy::motion
