// A world of robots in this process, and one robot of it, as Python has them.
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "assembly/command_port.h"
#include "assembly/simulation.h"
#include "config/load.h"
#include "emulator/told_event.h"

namespace understudy::python {

// For one thread. Does not move.
class PythonWorld : public std::enable_shared_from_this<PythonWorld> {
 public:
  // Throws ConfigError or ModelError.
  explicit PythonWorld(const config::Layers& layers);
  // As assembly::Simulation's: of the same configuration, without compiling it again.
  explicit PythonWorld(const assembly::Simulation& like);

  // As assembly::Simulation::Begin; commands that wait and events that nobody has taken are gone.
  void Begin(int seed, const std::vector<assembly::Place>& at = {});

  assembly::Simulation& simulation() { return *simulation_; }
  assembly::CommandPort& port(std::size_t robot) { return ports_[robot]; }
  // Steps of the physics in `seconds`. Throws std::invalid_argument if that is no whole number of
  // them, or less than one.
  int StepsOf(double seconds) const;
  // Returns the events of a robot since the last call, and those of the world.
  std::vector<emulator::ToldEvent> TakeEvents(std::size_t robot);

 private:
  assembly::PortsOf OwnPorts();
  void BeginPorts();  // as new ones, at the time step that was drawn; events are read from now on

  std::deque<assembly::CommandPort> ports_;  // by robot
  std::unique_ptr<assembly::Simulation> simulation_;
  std::vector<emulator::EventRing::Reader> events_;  // by robot
};

// One robot of a world, which it keeps.
class PythonRobot {
 public:
  PythonRobot(std::shared_ptr<PythonWorld> world, std::size_t index);

  PythonWorld& world() const { return *world_; }
  std::size_t index() const { return index_; }
  const robot::RobotSpec& spec() const;
  const physics::RobotBody& body() const;
  const emulator::Robot& part() const;

  // Returns the number of a topic of commands. Throws std::invalid_argument, which names those that
  // there are, if the robot does not have it.
  std::size_t TopicOf(const std::string& topic) const;
  // Returns a command of that topic in which nobody has set anything: 0; of hands that follow
  // goals, full speed, or the speed and most torque of the command before.
  robot::RobotCommand CommandOf(std::size_t topic) const;
  // Returns the last LowState. Throws std::runtime_error before the first.
  const robot::RobotState& lowstate() const;
  // Carries out a request on this robot; `values` is a JSON object. Throws ControlError.
  void Request(const std::string& name, const std::string& values) const;

 private:
  std::shared_ptr<PythonWorld> world_;
  std::size_t index_;
};

}  // namespace understudy::python
