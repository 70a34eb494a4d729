#include "run/recording.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <map>
#include <optional>

#include <mujoco/mujoco.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include "base/errors.h"
#include "config/load.h"
#include "mjcf/compile.h"
#include "mjcf/join.h"
#include "mjcf/urdf.h"
#include "physics/world_reading.h"
#include "robot/hand_law.h"
#include "robot/pads.h"
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

record::Damage SheetOf(const emulator::World& world, std::size_t robot) {
  const emulator::Snapshot snapshot = world.MakeSnapshot(robot);
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

// Where the base of a robot stands in the truth.
record::BaseAddress BaseOf(const physics::MujocoWorld& world, std::size_t robot) {
  const physics::RobotBody& body = world.robot(robot);
  if (body.base_position().empty()) return {};
  return {.qpos = static_cast<std::size_t>(body.base_position().data() - world.data().qpos),
          .qvel = static_cast<std::size_t>(body.base_velocity().data() - world.data().qvel)};
}

record::ObjectAddresses ObjectsOf(const physics::MujocoWorld& world) {
  record::ObjectAddresses objects;
  for (const physics::LooseBody& object : world.objects()) {
    objects[object.name] = {.qpos = object.q, .qvel = object.v};
  }
  return objects;
}

record::RecordingHead HeadOf(const config::Config& config, std::size_t number,
                             const robot::Draws& draws, const emulator::World& world) {
  const config::RobotConfig& robot = config.robots[number];
  std::string motors, slots;
  for (const robot::MotorSpec& motor : robot.spec.motors) {
    const char* space = motors.empty() ? "" : " ";
    motors += space + motor.joint;
    slots += space + std::to_string(motor.slot);
  }
  record::RecordingHead head;
  head.about = {{"robot", robot.spec.name},
                {"revision", robot.spec.revision},
                {"profile", robot.profile},
                {"family", robot.spec.family == robot::WireFamily::kGo ? "go" : "hg"},
                {"motors", motors},
                {"slots", slots},
                {"version", kVersion},
                {"mujoco", mjcf::MujocoVersion()},
                {"started", Now("%Y-%m-%dT%H:%M:%SZ")},
                {"seed", draws.seed < 0 ? "" : std::to_string(draws.seed)},
                {"sensors_seed", std::to_string(robot.sensors.seed)},
                {"draws", DrawnText(draws)}};
  if (config.robots.size() > 1) head.about["name"] = robot.name;
  head.damage = SheetOf(world, number);
  head.events_of = number;
  head.base = BaseOf(world.physics(), number);
  head.objects = ObjectsOf(world.physics());
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
std::optional<record::RosRobot> RosRobotOf(const config::Config& config, std::size_t number,
                                           const mjModel& model, std::int64_t every) {
  if (config.recording.ros_hz <= 0) return {};
  try {
    const config::RobotConfig& own = config.robots[number];
    // With its names in the model.
    const robot::RobotSpec spec = mjcf::WithPrefix(config.PrefixOf(own), own.spec);
    std::map<std::string, mjcf::UrdfLimits> limits;
    std::map<std::string, int> motors;
    for (const robot::MotorSpec* motor : robot::AllMotors(spec)) {
      motors.try_emplace(motor->joint, static_cast<int>(motors.size()));
      limits[motor->joint] = {.effort = motor->torque_limit, .velocity = motor->no_load_speed};
    }
    record::RosRobot ros{.tree = mjcf::TreeOf(model, spec.base_body)};
    for (const mjcf::TreeJoint& joint : ros.tree.joints) {
      const auto motor = motors.find(joint.name);
      ros.motors.push_back(motor == motors.end() ? -1 : motor->second);
    }
    ros.urdf =
        mjcf::UrdfOf(model, own.spec.name, ros.tree, limits, mjcf::MeshUse::kPrimitives).text;
    ros.scene = mjcf::SceneShapesOf(model, spec.base_body);
    ros.every = RosEvery(config.recording.ros_hz, config.physics.timestep, every);
    return ros;
  } catch (const ModelError& error) {
    Log(std::string("is without /tf and /robot_description: ") + error.what(), false);
    return {};
  }
}

// Makes the truth of a robot; sizes do not change during a run. `cells` is of its pads.
void Fill(const emulator::World& world, std::size_t number, std::span<float> cells,
          record::Truth* truth) {
  const emulator::Robot& robot = world.robot(number);
  const physics::Crane& crane = robot.crane();
  truth->step = world.step();
  truth->time = world.time();
  physics::ReadPositions(world.physics(), truth->qpos);
  physics::ReadRates(world.physics(), truth->qvel);
  truth->tau.assign(robot.torque().begin(), robot.torque().end());
  world.physics().robot(number).FootForces(truth->foot_force);
  world.physics().robot(number).HandForces(truth->hand_force);
  world.physics().robot(number).ReadTouch(cells);
  robot::StrongestCells(robot.spec(), cells, truth->touch);
  truth->crane_tension = crane.attached() ? crane.tension() : 0;
}

record::Moment Prototype(const robot::RobotSpec& spec, const emulator::World& world) {
  const auto zeros = [](std::size_t count) { return std::vector<double>(count); };
  return {.truth = {.qpos = zeros(physics::PositionCount(world.physics())),
                    .qvel = zeros(physics::RateCount(world.physics())),
                    .tau = zeros(robot::AllMotors(spec).size()),
                    .foot_force = zeros(spec.feet.size()),
                    .hand_force = zeros(robot::HandNames(spec).size()),
                    .touch = zeros(robot::PadNames(spec).size())}};
}

}  // namespace

std::filesystem::path RecordingOf(std::filesystem::path file, const config::Config& config,
                                  std::size_t robot) {
  if (config.robots.size() == 1 || file.empty()) return file;
  return file.replace_filename(file.stem().string() + "_" + config.robots[robot].name +
                               file.extension().string());
}

Recording::Recording(const RecordingOptions& options, std::size_t robot,
                     const bus::Participant& participant, const config::Config& config,
                     const robot::Draws& draws, std::shared_ptr<const assembly::SightModel> sight,
                     emulator::World* world)
    : robot_(robot),
      participant_(participant),
      config_(config),
      sight_(std::move(sight)),
      world_(*world),
      late_messages_(options.late_messages),
      audience_(options.audience),
      head_(HeadOf(config, robot, draws, *world)),
      moment_(Prototype(config.robots[robot].spec, *world)),
      cells_(robot::CellsOf(config.robots[robot].spec)),
      every_(std::max<std::int64_t>(
          1, std::llround(
                 1 / (config.robots[robot].spec.rates.lowstate_hz * config.physics.timestep)))),
      sheet_every_(std::max<std::int64_t>(1, std::llround(kSheetEvery / config.physics.timestep))) {
  head_.start = options.start;
  if (options.obstacles) obstacles_.emplace(world->physics(), robot);
  if (!options.file.empty()) {
    recorder_ = Start({.file = options.file, .overwrite = options.overwrite, .config = config});
    file_ = options.file;
    spdlog::info("recording to {}", options.file.string());
  }
  if (audience_ != nullptr) return;
  world_.recording(robot_).Open(recorder_ != nullptr);
  thread_ = std::jthread([this](const std::stop_token& stop) { Work(stop); });
}

// With what requests have changed since the start.
config::Config Recording::ConfigInEffect() const {
  config::Config config = config_;
  config::TakeSettings(world_.settings(), &config);
  for (std::size_t i = 0; i < config.robots.size(); ++i) {
    config::TakeSettings(world_.robot(i).settings(), &config.robots[i]);
  }
  config.time.speed = world_.pace().speed;
  return config;
}

std::unique_ptr<record::Recorder> Recording::Start(const Job& job) const {
  record::OutputFile output(job.file, job.overwrite, job.links);
  record::RecordingHead head = head_;
  head.about["speed"] = std::to_string(job.config.time.speed);
  head.config = config::PrintConfig(job.config, false);
  const std::shared_ptr<const mjModel> model = sight_->Get();
  head.model = mjcf::ModelBytes(*model);
  head.ros = RosRobotOf(job.config, robot_, *model, every_);
  return std::make_unique<record::Recorder>(
      participant_, std::move(output), head, &world_.events(), moment_,
      std::chrono::nanoseconds(std::llround(config_.physics.timestep * 1e9)), job.first_step, &Log,
      audience_);
}

void Recording::Work(const std::stop_token& stop) {
  const std::stop_callback stopped(stop, [this] { wake_.release(); });
  while (true) {
    wake_.acquire();
    if (turn_ == Turn::kThreads) {
      try {
        const bool finishes = job_.recorder != nullptr;
        job_.recorder = finishes ? nullptr : Start(job_);
      } catch (const std::exception& error) {
        job_.why = error.what();
      }
      turn_ = Turn::kTicks;
    }
    if (stop.stop_requested()) return;
  }
}

bool Recording::TakeTurn() {
  if (turn_ == Turn::kThreads) return false;
  if (turn_ == Turn::kTicks) {
    End();
    return true;
  }
  if (const auto* order = world_.recording(robot_).order()) Begin(*order);
  return false;
}

void Recording::Begin(const emulator::RecordingOrder& order) {
  if (order.starts) {
    const std::string own = (config_.robots.size() == 1 ? robot().spec.name : robot().name) + "_" +
                            Now("%Y-%m-%d_%H-%M-%S") + ".mcap";
    const std::string_view asked = order.file.data();
    file_ = std::filesystem::absolute(asked.empty() ? std::string_view(own) : asked);
    job_ = {.file = file_,
            .overwrite = order.overwrite,
            .links = record::Links::kRefused,  // its folder may be one that others write to
            .first_step = world_.step(),
            .config = ConfigInEffect()};
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
  emulator::RecordingDesk& desk = world_.recording(robot_);
  if (!job_.why.empty()) {
    world_.events().Add(emulator::EventKind::kRecordingFailed, static_cast<std::uint8_t>(robot_),
                        {}, job_.why);
    return desk.Done(false, Error{job_.why});
  }
  const bool on = recorder_ != nullptr;
  world_.events().Add(emulator::EventKind::kRecording, static_cast<std::uint8_t>(robot_),
                      {on ? 1.0 : 0.0}, file);
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
  moment->damage.sheet = world_.robot(robot_).damage();
  recorder_->CommitDamage();
  sheet_step_ = world_.step();
}

bool Recording::AllowsStep() const {
  return recorder_ == nullptr || world_.pace().speed != 0 || !recorder_->behind();
}

std::optional<ExitCode> Recording::After(const Cycle& cycle) {
  if (cycle.ticked && recorder_ != nullptr) Offer();
  turned_ = TakeTurn();
  return {};
}

void Recording::Offer() {
  recorder_->Mark(world_.step() - 1);
  if (world_.step() % every_ == 0) {
    if (record::Moment* moment = recorder_->Claim(); moment != nullptr) {
      Fill(world_, robot_, cells_, &moment->truth);
      if (obstacles_) {
        moment->truth.nearest_obstacle =
            obstacles_->Measure(world_.step(), world_.physics().data());
      }
      recorder_->Commit();
    }
  }
  if (world_.step() % sheet_every_ == 0) OfferDamage();
  const bool heard =
      audience_ != nullptr && world_.pace().speed == 0 && world_.step() % kHeardEvery == 0;
  if (late_messages_ || heard) {
    recorder_->CatchUp();
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
