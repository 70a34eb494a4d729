// Many worlds of one robot, stepped side by side over threads, with their states in arrays.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "config/load.h"
#include "python/python_world.h"

namespace understudy::python {

// A value of each robot: `width` numbers a robot, one robot after the other.
struct Column {
  const char* name;
  const char* what;  // unit and frame
  bool truth;        // of the simulation; else as sensed
  std::size_t width = 0;
  std::vector<float> values{};
};

// A robot's world does not know the others, so results do not depend on the threads. For one
// thread.
class Batch {
 public:
  // Makes `count` robots with the seeds `seed`, `seed` + 1, ... over so many threads. Throws
  // ConfigError or ModelError, and std::invalid_argument where there is not one robot a world.
  Batch(const config::Layers& layers, std::size_t count, std::size_t threads, int seed);

  std::size_t size() const { return worlds_.size(); }
  PythonRobot robot(std::size_t i) const { return {worlds_[i], 0}; }

  // Gives each robot a command: `motors` has those of the first robot, then those of the next.
  void Command(std::span<const robot::MotorCommand> motors);
  // Steps all robots by so many seconds and reads their states. Throws as Simulation::Step, once
  // the others have been stepped, and std::invalid_argument as PythonWorld::StepsOf.
  void Step(double seconds);
  // Begins the episodes of these robots anew, each by its seed, and makes one step, so that there
  // is a state. `seeds` has as many as `robots`, and so has `at`, or it is empty: the robots are
  // where their configuration has them. Throws as PythonWorld::Begin.
  void Begin(std::span<const std::size_t> robots, std::span<const int> seeds,
             std::span<const assembly::Place> at = {});

  const std::vector<Column>& columns() const { return columns_; }

 private:
  // Calls `act` with each of these numbers, over all threads. Rethrows what one has thrown.
  void OverThreads(std::size_t count, const std::function<void(std::size_t)>& act) const;
  void Read(std::size_t i);

  std::size_t threads_;
  std::vector<std::shared_ptr<PythonWorld>> worlds_;
  std::vector<Column> columns_;
};

}  // namespace understudy::python
