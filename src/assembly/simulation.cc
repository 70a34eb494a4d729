#include "assembly/simulation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/errors.h"
#include "base/printed.h"
#include "emulator/request.h"

namespace understudy::assembly {
namespace {

// Wall time is simulated time: leases of services last as long as on a robot.
time::Clock::Time TimeOf(const emulator::World& world) {
  return std::chrono::duration_cast<time::Clock::Time>(std::chrono::duration<double>(world.time()));
}

// Ends a world and returns its memory.
mjcf::DataHandle MemoryOf(std::unique_ptr<emulator::World> world) {
  physics::MujocoWorld physics = std::move(*world).TakePhysics();
  world.reset();
  return std::move(physics).TakeMemory();
}

}  // namespace

Simulation::Simulation(config::Config config, const PortsOf& ports)
    : given_(std::move(config)), ports_(ports), config_(given_) {
  Make();
}

Simulation::Simulation(const Simulation& like, const PortsOf& ports)
    : given_(like.given_), ports_(ports), reused_{like.reused_.models, nullptr}, config_(given_) {
  Make();
}

void Simulation::Begin(int seed, const std::vector<Place>& at) {
  const auto is_far = [](double x) { return !(std::abs(x) <= config::kFurthestStart); };
  if (at.size() > given_.robots.size() ||
      std::ranges::any_of(at, [&](const Place& one) { return std::ranges::any_of(one, is_far); })) {
    throw std::invalid_argument(Printed("begin: expected places of %zu robots at most, within %g",
                                        given_.robots.size(), config::kFurthestStart));
  }
  config_ = given_;
  for (std::size_t i = 0; i < at.size(); ++i) config_.robots[i].start.at = at[i];
  config_.randomization.seed = seed;
  for (config::RobotConfig& robot : config_.robots) robot.sensors.seed = seed;
  try {
    Make();
  } catch (...) {  // a time step that was drawn, and a model that is gone
    config_ = given_;
    Make();
    throw;
  }
}

void Simulation::Make() {
  if (world_ != nullptr) reused_.memory = MemoryOf(std::move(world_));
  MadePhysics made = MakePhysics(&config_, &reused_);
  null_ports_.clear();
  inbox_ = std::make_unique<emulator::Inbox>();
  draws_ = std::move(made.draws);
  notes_ = std::move(made.notes);
  sight_ = std::move(made.sight);
  const auto ports_or_none = [&](std::size_t robot) {
    emulator::Ports own = ports_ ? ports_(robot) : emulator::Ports{nullptr};
    if (own.topics == nullptr) {
      own.topics = &null_ports_.emplace_back(config_.robots[robot].spec, config_.physics.timestep);
    }
    own.topics->Clear();
    return own;
  };
  world_ = MakeWorld(std::move(made.world), config_, ports_or_none, inbox_.get());
}

void Simulation::Request(std::string_view name, const nlohmann::json& values) {
  const auto request = emulator::ReadRequest(name, values);
  if (!request) throw ControlError(request.why());
  auto asked = inbox_->Put(*request);
  world_->Attend(TimeOf(*world_));
  if (request->waits()) return;
  if (const emulator::Answer done = asked->answer.get(); !done) throw ControlError(done.why());
}

void Simulation::Step(int steps) {
  for (int i = 0; i < steps; ++i) {
    const physics::StepHealth health = world_->Tick(TimeOf(*world_));
    if (health == physics::StepHealth::kDiverged && !world_->resets_on_divergence()) {
      throw std::runtime_error(Printed("the physics diverged at %.3f s", world_->time()));
    }
  }
}

}  // namespace understudy::assembly
