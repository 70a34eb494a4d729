#include "python/batch_module.h"

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include "python/arguments.h"
#include "python/batch.h"

namespace understudy::python {

namespace nb = nanobind;
using nb::literals::operator""_a;

void BindBatch(nb::module_& m) {
  using Floats = nb::ndarray<nb::numpy, const float>;
  const auto columns = [](bool truth) {
    return [truth](Batch& batch) {
      nb::dict views;
      for (const Column& column : batch.columns()) {
        if (column.truth != truth) continue;
        views[column.name] =
            Floats(column.values.data(), {batch.size(), column.width}, nb::find(batch));
      }
      return views;
    };
  };
  nb::class_<Batch>(m, "Batch", "Many robots of a kind, each in a world of its own, over threads.")
      .def(nb::new_([](const nb::object& name, std::size_t count, std::size_t threads,
                       const nb::object& files, const nb::dict& sets, int seed) {
             const config::Layers layers = LayersOf({name}, files, sets, seed);
             const nb::gil_scoped_release release;
             return std::make_unique<Batch>(layers, count, threads, seed);
           }),
           "name"_a, "count"_a, nb::kw_only(), "threads"_a = 1, "config"_a = nb::tuple(),
           "set"_a = nb::dict(), "seed"_a = 1,
           "Makes `count` robots with the seeds seed, seed + 1, ...; the other arguments are those "
           "of World. Each has made one step, so that there are states.")
      .def("__len__", &Batch::size)
      .def_prop_ro("robots",
                   [](const Batch& batch) {
                     std::vector<PythonRobot> robots;
                     for (std::size_t i = 0; i < batch.size(); ++i) {
                       robots.push_back(batch.robot(i));
                     }
                     return robots;
                   })
      .def_prop_ro("state", columns(false),
                   "Arrays by name, float32, shape (robots, width): what LowStates tell. Views: "
                   "step and begin write into them.")
      .def_prop_ro("truth", columns(true),
                   "The same of what the simulation knows: position, velocity, attitude and "
                   "turning_rate of the base, torque, contact_force, tilt.")
      .def(
          "command",
          [](Batch& batch, const nb::object& q, const nb::object& dq, const nb::object& tau,
             const nb::object& kp, const nb::object& kd) {
            const std::size_t motors = batch.robot(0).spec().motors.size();
            std::vector<robot::MotorCommand> commands(motors * batch.size(), {.enabled = true});
            Fill({&q, &dq, &tau, &kp, &kd}, motors, commands);
            batch.Command(commands);
          },
          nb::kw_only(), "q"_a = 0.0, "dq"_a = 0.0, "tau"_a = 0.0, "kp"_a = 0.0, "kd"_a = 0.0,
          "Sends each robot a LowCmd, as Robot.command: numbers, or arrays of shape (motors,) or "
          "(robots, motors).")
      .def("step", &Batch::Step, nb::call_guard<nb::gil_scoped_release>(), "seconds"_a,
           "Steps all robots and writes their states. Raises RuntimeError when the physics of one "
           "diverges.")
      .def(
          "begin",
          [](Batch& batch, const std::vector<std::size_t>& robots, const std::vector<int>& seeds,
             const std::vector<assembly::Place>& at) {
            const auto require = [&](const char* what, std::size_t count) {
              if (count == robots.size()) return;
              throw std::invalid_argument("begin: expected as many " + std::string(what) +
                                          " as robots, got " + std::to_string(count) + " and " +
                                          std::to_string(robots.size()));
            };
            require("seeds", seeds.size());
            if (!at.empty()) require("places", at.size());
            for (const std::size_t robot : robots) {
              if (robot >= batch.size()) {
                throw std::invalid_argument("begin: there is no robot " + std::to_string(robot));
              }
            }
            const nb::gil_scoped_release release;
            batch.Begin(robots, seeds, at);
          },
          "robots"_a, "seeds"_a, "at"_a = std::vector<assembly::Place>(),
          "Begins new episodes of robots, by their numbers, each by its seed, and makes one step. "
          "`at`, shape (robots, 3), has x, y [m] and yaw [rad] of each in the world; without it "
          "they begin at start.at.");
}

}  // namespace understudy::python
