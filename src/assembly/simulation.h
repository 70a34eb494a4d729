// A world within this process, which runs as its owner steps it.
#pragma once

#include <array>
#include <deque>
#include <memory>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "assembly/make_world.h"
#include "assembly/null_port.h"
#include "config/config.h"
#include "emulator/inbox.h"
#include "emulator/world.h"

namespace understudy::assembly {

// x, y [m] and yaw [rad] in the world.
using Place = std::array<double, 3>;

// Has no thread, no network and no log, and never waits. For one thread
// (docs/reference/embedding.md).
class Simulation {
 public:
  // `config` is validated, as config::LoadConfig returns it. `ports` must outlive the simulation;
  // empty, or where it returns a null port, the robot has a NullPort. Throws ModelError, and
  // ConfigError for a planned fault that a robot cannot have.
  explicit Simulation(config::Config config, const PortsOf& ports = {});
  // Of the configuration that `like` was made of, with ports of its own. Nothing is compiled that
  // `like` has compiled, so this takes a twentieth of the time. Threads may do this at once.
  Simulation(const Simulation& like, const PortsOf& ports);
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  // Begins anew with other seeds, of the sensors and of what is drawn at random: bit for bit as a
  // new simulation whose sensors.seed and randomization.seed are `seed`, which must not be
  // negative. Nothing is compiled but for a time step that is drawn for the first time. World,
  // notes and draws are new ones, in the memory of the old; ports are cleared. `at` has places of
  // the first robots in place of their start.at, within a kilometre; a fixed base stays where it
  // is. Throws as the constructor; then it has begun as at first. Throws std::invalid_argument for
  // places of more robots than there are, or further away, and has not begun.
  void Begin(int seed, const std::vector<Place>& at = {});

  // Carries out a request (docs/reference/requests.md) such as "push" with its values before the
  // next step. Throws ControlError with the reason if it is refused. One that takes time, such as
  // step, goes on in the steps that follow.
  void Request(std::string_view name, const nlohmann::json& values = nlohmann::json::object());

  // Makes steps of config().physics.timestep each. Throws std::runtime_error when the physics
  // diverges, unless physics.on_divergence is reset.
  void Step(int steps = 1);

  emulator::World& world() { return *world_; }
  const emulator::World& world() const { return *world_; }
  // The configuration in effect: with a third-party model's names and with what was drawn.
  const config::Config& config() const { return config_; }
  const robot::Draws& draws() const { return draws_; }
  const std::vector<Note>& notes() const { return notes_; }
  const SightModel& sight() const { return *sight_; }

 private:
  void Make();

  config::Config given_;
  PortsOf ports_;
  Reused reused_;
  config::Config config_;
  robot::Draws draws_;
  std::vector<Note> notes_;
  std::shared_ptr<const SightModel> sight_;
  std::deque<NullPort> null_ports_;
  std::unique_ptr<emulator::Inbox> inbox_;
  std::unique_ptr<emulator::World> world_;
};

}  // namespace understudy::assembly
