#include "run/recording.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <map>
#include <optional>
#include <thread>

#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include "base/errors.h"
#include "config/load.h"
#include "mjcf/compile.h"
#include "mjcf/urdf.h"
#include "physics/world_reading.h"
#include "run/make_world.h"
#include "version.h"

namespace understudy::run {
namespace {

std::string Now(const char* format) {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), format, &utc);
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
  for (const robot::MotorLimits& limits : snapshot.limits) {
    damage.torque_limit.push_back(limits.torque);
    damage.speed_limit.push_back(limits.speed);
    damage.jump_limit.push_back(limits.jump);
  }
  damage.limits = snapshot.damage_limits;
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
                {"profile", config.profile},
                {"family", config.robot.family == robot::WireFamily::kGo ? "go" : "hg"},
                {"motors", motors},
                {"slots", slots},
                {"version", kVersion},
                {"mujoco", mjcf::MujocoVersion()},
                {"started", Now("%Y-%m-%dT%H:%M:%SZ")},
                {"speed", std::to_string(config.time.speed)},
                {"seed", draws.seed < 0 ? "" : std::to_string(draws.seed)},
                {"sensors_seed", std::to_string(config.sensors.seed)},
                {"draws", DrawnText(draws)}};
  head.damage = SheetOf(world);
  return head;
}

// Steps from one message of the rate `hz` to the next, a multiple of `every`.
std::int64_t RosEvery(double hz, double timestep, std::int64_t every) {
  return every *
         std::max<std::int64_t>(1, std::llround(1 / (hz * timestep * static_cast<double>(every))));
}

void Log(const std::string& line, bool error) {
  spdlog::log(error ? spdlog::level::err : spdlog::level::warn, "recording: {}", line);
}

// Of a robot that has no equal in URDF there are no topics of ROS.
std::optional<record::RosRobot> RosRobotOf(const config::Config& config, const mjModel& model,
                                           std::int64_t every) {
  if (config.recording.ros_hz <= 0) return {};
  try {
    std::map<std::string, mjcf::UrdfLimits> limits;
    std::map<std::string, int> motors;
    for (const robot::MotorSpec* motor : robot::AllMotors(config.robot)) {
      motors.try_emplace(motor->joint, static_cast<int>(motors.size()));
      limits[motor->joint] = {.effort = motor->torque_limit, .velocity = motor->no_load_speed};
    }
    record::RosRobot ros{.tree = mjcf::TreeOf(model, config.robot.base_body)};
    for (const mjcf::TreeJoint& joint : ros.tree.joints) {
      const auto motor = motors.find(joint.name);
      ros.motors.push_back(motor == motors.end() ? -1 : motor->second);
    }
    ros.urdf = mjcf::UrdfOf(model, config.robot.name, ros.tree, limits, mjcf::MeshUse::kBoxes).text;
    ros.scene = mjcf::SceneShapesOf(model, config.robot.base_body);
    ros.every = RosEvery(config.recording.ros_hz, config.physics.timestep, every);
    return ros;
  } catch (const ModelError& error) {
    Log(std::string("is without /tf and /robot_description: ") + error.what(), false);
    return {};
  }
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

}  // namespace

Recording::Recording(const RecordingOptions& options, const bus::Participant& participant,
                     const config::Config& config, const robot::Draws& draws,
                     emulator::World* world)
    : participant_(participant),
      config_(config),
      world_(*world),
      audience_(options.audience),
      head_(HeadOf(config, draws, *world)),
      moment_(Prototype(config, *world)),
      every_(std::max<std::int64_t>(
          1, std::llround(1 / (config.robot.rates.lowstate_hz * config.physics.timestep)))),
      sheet_every_(std::max<std::int64_t>(1, std::llround(kSheetEvery / config.physics.timestep))) {
  if (!options.file.empty()) {
    recorder_ = Start(options.file, options.overwrite, 0);
    file_ = options.file;
    spdlog::info("recording to {}", options.file.string());
  }
  if (audience_ != nullptr) return;
  world_.recording().Open(recorder_ != nullptr);
  thread_ = std::jthread([this](const std::stop_token& stop) { Work(stop); });
}

std::unique_ptr<record::Recorder> Recording::Start(std::filesystem::path file, bool overwrite,
                                                   std::int64_t first_step) const {
  record::OutputFile output(std::move(file), overwrite);
  record::RecordingHead head = head_;
  head.config = config::PrintConfig(config_, false);
  const mjcf::ModelHandle model = MakeSightModel(config_);
  head.model = mjcf::ModelBytes(*model);
  head.ros = RosRobotOf(config_, *model, every_);
  return std::make_unique<record::Recorder>(
      participant_, std::move(output), head, &world_.events(), moment_,
      std::chrono::nanoseconds(std::llround(config_.physics.timestep * 1e9)), first_step, &Log,
      audience_);
}

void Recording::Work(const std::stop_token& stop) {
  const std::stop_callback stopped(stop, [this] { wake_.release(); });
  while (true) {
    wake_.acquire();
    if (turn_ == Turn::kThreads) {
      try {
        const bool finishes = job_.recorder != nullptr;
        job_.recorder = finishes ? nullptr : Start(job_.file, job_.overwrite, job_.first_step);
      } catch (const std::exception& error) {
        job_.why = error.what();
      }
      turn_ = Turn::kTicks;
    }
    if (stop.stop_requested()) return;
  }
}

bool Recording::Follow() {
  if (turn_ == Turn::kThreads) return false;
  if (turn_ == Turn::kTicks) {
    End();
    return true;
  }
  if (const auto* order = world_.recording().order()) Begin(*order);
  return false;
}

void Recording::Begin(const emulator::RecordingOrder& order) {
  if (order.starts) {
    const std::string own = config_.robot.name + "_" + Now("%Y-%m-%d_%H-%M-%S") + ".mcap";
    const std::string_view asked = order.file.data();
    file_ = std::filesystem::absolute(asked.empty() ? std::string_view(own) : asked);
    job_ = {.file = file_, .overwrite = order.overwrite, .first_step = world_.step()};
  } else {
    OfferDamage();
    const bool failed = recorder_->status().state == emulator::RecordingState::kFailed;
    job_ = {.recorder = std::move(recorder_),
            .why = failed ? "the recording had failed; what was written until then is in " +
                                file_.string()
                          : ""};
  }
  turn_ = Turn::kThreads;
  wake_.release();
}

void Recording::End() {
  turn_ = Turn::kNobodys;
  const std::string file = file_.string();
  recorder_ = std::move(job_.recorder);
  if (recorder_ == nullptr) file_.clear();
  emulator::RecordingDesk& desk = world_.recording();
  if (!job_.why.empty()) {
    world_.events().Add(emulator::EventKind::kRecordingFailed, 0, {}, job_.why);
    return desk.Done(false, Error{job_.why});
  }
  const bool on = recorder_ != nullptr;
  world_.events().Add(emulator::EventKind::kRecording, 0, {on ? 1.0 : 0.0}, file);
  desk.Done(on, {});
}

Recording::~Recording() {
  thread_ = {};
  if (turn_ == Turn::kTicks) End();
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
  if (audience_ != nullptr && world_.step() % kHeardEvery == 0) recorder_->CatchUp();
  while (recorder_->behind()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

emulator::RecordingStatus Recording::status() const {
  emulator::RecordingStatus status;
  if (recorder_ == nullptr) return status;
  status = recorder_->status();
  emulator::CopyText(file_.native(), &status.file);
  return status;
}

}  // namespace understudy::run
