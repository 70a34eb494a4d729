#include "python/python_world.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/errors.h"
#include "base/printed.h"
#include "config/data_dir.h"
#include "robot/hand_law.h"

namespace understudy::python {

PythonWorld::PythonWorld(const config::Layers& layers) {
  const config::Config config = config::LoadConfig(layers, config::DataDir());
  for (const config::RobotConfig& robot : config.robots) {
    ports_.emplace_back(robot.spec, config.physics.timestep);
  }
  simulation_ = std::make_unique<assembly::Simulation>(config, OwnPorts());
  BeginPorts();
}

PythonWorld::PythonWorld(const assembly::Simulation& like) {
  for (const config::RobotConfig& robot : like.config().robots) {
    ports_.emplace_back(robot.spec, like.config().physics.timestep);
  }
  simulation_ = std::make_unique<assembly::Simulation>(like, OwnPorts());
  BeginPorts();
}

void PythonWorld::Begin(int seed, const std::vector<assembly::Place>& at) {
  if (seed < 0) throw std::invalid_argument("begin: expected a seed of 0 or more");
  try {
    simulation_->Begin(seed, at);
  } catch (const std::invalid_argument&) {  // it has not begun
    throw;
  } catch (...) {  // it has begun as at first
    BeginPorts();
    throw;
  }
  BeginPorts();
}

assembly::PortsOf PythonWorld::OwnPorts() {
  return [this](std::size_t robot) { return emulator::Ports{&ports_[robot]}; };
}

void PythonWorld::BeginPorts() {
  const config::Config& config = simulation_->config();
  for (std::size_t i = 0; i < ports_.size(); ++i) {
    ports_[i] = assembly::CommandPort(config.robots[i].spec, config.physics.timestep);
  }
  events_.assign(ports_.size(), emulator::EventRing::Reader(&simulation_->world().events()));
}

int PythonWorld::StepsOf(double seconds) const {
  const double timestep = simulation_->config().physics.timestep;
  const double steps = seconds / timestep;
  constexpr double kMost = 1e9;
  if (!(steps > 0.5 && steps < kMost) || std::abs(steps - std::round(steps)) > 1e-6 * steps) {
    throw std::invalid_argument(
        Printed("step: expected a whole number of steps of %g s, got %g s", timestep, seconds));
  }
  return static_cast<int>(std::lround(steps));
}

std::vector<emulator::ToldEvent> PythonWorld::TakeEvents(std::size_t robot) {
  std::vector<emulator::ToldEvent> taken;
  emulator::Event event;
  while (events_[robot].Next(&event)) {
    if (event.robot == robot || emulator::RowOf(event.kind).of_world)
      taken.push_back({.event = event});
  }
  return taken;
}

PythonRobot::PythonRobot(std::shared_ptr<PythonWorld> world, std::size_t index)
    : world_(std::move(world)), index_(index) {}

const robot::RobotSpec& PythonRobot::spec() const {
  return world_->simulation().config().robots[index_].spec;
}

const physics::RobotBody& PythonRobot::body() const {
  return world_->simulation().world().physics().robot(index_);
}

const emulator::Robot& PythonRobot::part() const {
  return world_->simulation().world().robot(index_);
}

std::size_t PythonRobot::TopicOf(const std::string& topic) const {
  const std::vector<std::string>& topics = part().topics();
  std::string known;
  for (std::size_t i = 0; i < topics.size(); ++i) {
    if (topics[i].empty()) continue;
    if (topics[i] == topic) return i;
    known += (known.empty() ? "" : ", ") + topics[i];
  }
  throw std::invalid_argument("command: expected one of the topics " + known + ", got '" + topic +
                              "'");
}

robot::RobotCommand PythonRobot::CommandOf(std::size_t topic) const {
  using enum robot::HandLaw::Follows;
  robot::RobotCommand command;
  if (topic == robot::kHandSdkTopic) {
    command.motors.resize(robot::AllMotors(spec()).size() - spec().motors.size());
    return command;
  }
  if (topic < robot::kFirstHandTopic) {
    command.motors.resize(spec().motors.size());
    return command;
  }
  const robot::HandSpec& hand = spec().hands[topic - robot::kFirstHandTopic];
  const robot::HandLaw::Follows follows = robot::LawOf(hand).follows;
  for (const robot::MotorSpec& motor : hand.motors) {
    robot::MotorCommand& unsaid = command.motors.emplace_back();
    if (follows == kGoalsAtSpeed) unsaid.dq = motor.knee_speed;
    if (follows != kRegisters) continue;
    unsaid.dq = robot::kNoVelocity;
    unsaid.tau = -1;
  }
  return command;
}

const robot::RobotState& PythonRobot::lowstate() const {
  const robot::RobotState& state = world_->port(index_).lowstate();
  if (state.motors.empty()) throw std::runtime_error("state: there is none before the first step");
  return state;
}

void PythonRobot::Request(const std::string& name, const std::string& values) const {
  nlohmann::json object = nlohmann::json::parse(values);
  if (index_ > 0 && !object.contains("robot")) object["robot"] = index_;
  world_->simulation().Request(name, object);
}

}  // namespace understudy::python
