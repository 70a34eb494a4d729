#include "python/arguments.h"

#include <stdexcept>
#include <utility>

#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>

namespace understudy::python {
namespace {

namespace nb = nanobind;
using nb::literals::operator""_a;

// Returns `count` numbers: `values` is one for all, an array with one for each motor of a robot, or
// an array of all, of shape (robots, motors). Throws std::invalid_argument.
std::vector<double> PerMotor(const char* name, const nb::object& values, std::size_t motors,
                             std::size_t count) {
  using Numbers = nb::ndarray<const double, nb::c_contig, nb::device::cpu>;
  const auto array = nb::cast<Numbers>(
      nb::module_::import_("numpy").attr("ascontiguousarray")(values, "dtype"_a = "float64"));
  const std::size_t width = array.ndim() == 0 ? 1 : array.shape(array.ndim() - 1);
  const bool fits = array.size() == 1 || (width == motors && array.size() == motors) ||
                    (width == motors && array.size() == count);
  if (!fits || array.ndim() > 2) {
    const std::string robots = count == motors ? ""
                                               : " or (" + std::to_string(count / motors) + ", " +
                                                     std::to_string(motors) + ")";
    throw std::invalid_argument("command: expected " + std::string(name) +
                                " to be a number or an array of shape (" + std::to_string(motors) +
                                ",)" + robots + ", got " + std::to_string(array.size()) +
                                " numbers");
  }
  std::vector<double> all(count);
  for (std::size_t i = 0; i < count; ++i) all[i] = array.data()[i % array.size()];
  return all;
}

std::string PathOf(const nb::handle& path) {
  return nb::cast<std::string>(nb::module_::import_("os").attr("fspath")(path));
}

}  // namespace

void Fill(const std::array<const nb::object*, 5>& given, std::size_t motors,
          std::span<robot::MotorCommand> commands) {
  using robot::MotorCommand;
  constexpr std::pair<const char*, double MotorCommand::*> kFields[] = {{"q", &MotorCommand::q},
                                                                        {"dq", &MotorCommand::dq},
                                                                        {"tau", &MotorCommand::tau},
                                                                        {"kp", &MotorCommand::kp},
                                                                        {"kd", &MotorCommand::kd}};
  for (std::size_t field = 0; field < given.size(); ++field) {
    if (given[field]->is_none()) continue;
    const auto& [name, place] = kFields[field];
    const std::vector<double> all = PerMotor(name, *given[field], motors, commands.size());
    for (std::size_t i = 0; i < commands.size(); ++i) commands[i].*place = all[i];
  }
}

std::string JsonOf(const nb::handle& value) {
  const nb::object plain = nb::cpp_function([](const nb::object& array) {
    return array.attr("tolist")();  // what json itself does not know: numbers and arrays of numpy
  });
  return nb::cast<std::string>(
      nb::module_::import_("json").attr("dumps")(value, "default"_a = plain));
}

config::Layers LayersOf(const std::vector<nb::handle>& robots, const nb::object& files,
                        const nb::dict& sets, const std::optional<int>& seed) {
  if (robots.empty()) throw std::invalid_argument("World: expected the name of a robot");
  config::Layers layers{.robot = PathOf(robots.front())};
  for (std::size_t i = 1; i < robots.size(); ++i) layers.others.push_back(PathOf(robots[i]));
  if (nb::isinstance<nb::str>(files) || nb::hasattr(files, "__fspath__")) {
    layers.files.push_back(PathOf(files));
  } else {
    for (const nb::handle file : files) layers.files.push_back(PathOf(file));
  }
  if (seed) {
    layers.sets.push_back("sensors.seed=" + std::to_string(*seed));
    layers.sets.push_back("randomization.seed=" + std::to_string(*seed));
  }
  for (const auto& [key, value] : sets) {
    const std::string yaml =
        nb::isinstance<nb::str>(value) ? nb::cast<std::string>(value) : JsonOf(value);
    layers.sets.push_back(nb::cast<std::string>(key) + "=" + yaml);
  }
  return layers;
}

}  // namespace understudy::python
