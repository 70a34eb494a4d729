#include "run/recording.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <thread>

#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include "config/load.h"
#include "mjcf/compile.h"
#include "physics/world_reading.h"
#include "run/make_world.h"
#include "version.h"

namespace understudy::run {
namespace {

std::string Now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text.data();
}

std::string DrawnText(const robot::Draws& draws) {
  nlohmann::json drawn = nlohmann::json::array();
  for (const robot::Drawn& one : draws.values) {
    drawn.push_back({{"quantity", one.quantity}, {"element", one.element}, {"value", one.value}});
  }
  return drawn.dump();
}

// Simulated s from one damage sheet to the next; *assumed*.
constexpr double kSheetEvery = 1;

record::Damage SheetOf(const emulator::World& world) {
  const emulator::Snapshot snapshot = world.MakeSnapshot();
  record::Damage damage{
      .sheet = snapshot.damage, .trip_c = snapshot.trip_c, .joints = snapshot.motor_names};
  for (const emulator::SnapshotLimits& limits : snapshot.limits) {
    damage.torque_limit.push_back(limits.torque);
    damage.speed_limit.push_back(limits.speed);
  }
  return damage;
}

record::RecordingHead HeadOf(const config::Config& config, const robot::Draws& draws,
                             const emulator::World& world) {
  std::string motors, slots;
  for (const robot::MotorSpec& motor : config.robot.motors) {
    const char* space = motors.empty() ? "" : " ";
    motors += space + motor.joint;
    slots += space + std::to_string(motor.slot);
  }
  record::RecordingHead head;
  head.about = {{"robot", config.robot.name},
                {"revision", config.robot.revision},
                {"family", config.robot.family == robot::WireFamily::kGo ? "go" : "hg"},
                {"motors", motors},
                {"slots", slots},
                {"version", kVersion},
                {"mujoco", mjcf::MujocoVersion()},
                {"started", Now()},
                {"speed", std::to_string(config.time.speed)},
                {"seed", draws.seed < 0 ? "" : std::to_string(draws.seed)},
                {"draws", DrawnText(draws)}};
  head.config = config::PrintConfig(config, false);
  head.model = mjcf::ModelBytes(*MakeSightModel(config));
  head.damage = SheetOf(world);
  return head;
}

// Makes the truth of a robot; sizes do not change during a run.
void Fill(const emulator::World& world, record::Truth* truth) {
  const physics::Crane& crane = world.robot().crane();
  truth->step = world.step();
  truth->time = world.time();
  physics::ReadPositions(world.physics(), truth->qpos);
  physics::ReadRates(world.physics(), truth->qvel);
  truth->tau.assign(world.robot().torque().begin(), world.robot().torque().end());
  world.physics().robot().FootForces(truth->foot_force);
  truth->crane_tension = crane.attached() ? crane.tension() : 0;
}

record::Moment Prototype(const config::Config& config, const emulator::World& world) {
  const auto zeros = [](std::size_t count) { return std::vector<double>(count); };
  return {.truth = {.qpos = zeros(physics::PositionCount(world.physics())),
                    .qvel = zeros(physics::RateCount(world.physics())),
                    .tau = zeros(robot::AllMotors(config.robot).size()),
                    .foot_force = zeros(config.robot.feet.size())}};
}

void Log(const std::string& line, bool error) {
  spdlog::log(error ? spdlog::level::err : spdlog::level::warn, "recording: {}", line);
}

}  // namespace

Recording::Recording(const RecordingOptions& options, const bus::Participant& participant,
                     const config::Config& config, const robot::Draws& draws,
                     const emulator::World& world)
    : world_(world),
      every_(std::max<std::int64_t>(
          1, std::llround(1 / (config.robot.rates.lowstate_hz * config.physics.timestep)))),
      sheet_every_(std::max<std::int64_t>(1, std::llround(kSheetEvery / config.physics.timestep))),
      heard_(options.audience != nullptr) {
  if (options.file.empty()) return;
  recorder_ = std::make_unique<record::Recorder>(
      participant, record::OutputFile(options.file, options.overwrite),
      HeadOf(config, draws, world), &world.events(), Prototype(config, world),
      std::chrono::nanoseconds(std::llround(config.physics.timestep * 1e9)), &Log,
      options.audience);
  spdlog::info("recording to {}", options.file.string());
}

Recording::~Recording() {
  if (recorder_ == nullptr || sheet_step_ == world_.step()) return;
  recorder_->CatchUp();  // there is room then: the last sheet has all of them in it
  OfferDamage();
}

void Recording::OfferDamage() {
  record::DamageMoment* moment = recorder_->ClaimDamage();
  if (moment == nullptr) return;
  moment->damage.step = world_.step();
  moment->damage.sheet = world_.robot().damage();
  recorder_->CommitDamage();
  sheet_step_ = world_.step();
}

void Recording::Offer(const time::Pacer& pacer) {
  if (recorder_ == nullptr) return;
  recorder_->Mark(world_.step() - 1);
  if (world_.step() % every_ == 0) {
    if (record::Moment* moment = recorder_->Claim(); moment != nullptr) {
      Fill(world_, &moment->truth);
      recorder_->Commit();
    }
  }
  if (world_.step() % sheet_every_ == 0) OfferDamage();
  if (pacer.speed() != 0) return;
  if (heard_ && world_.step() % kHeardEvery == 0) recorder_->CatchUp();
  while (recorder_->behind()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

emulator::RecordingStatus Recording::status() const {
  return recorder_ == nullptr ? emulator::RecordingStatus{} : recorder_->status();
}

}  // namespace understudy::run
