#include "python/policy_module.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "config/data_dir.h"
#include "config/load.h"
#include "policy/policy.h"
#include "python/arguments.h"
#include "python/python_world.h"

namespace understudy::python {
namespace {

namespace nb = nanobind;
using nb::literals::operator""_a;

// Returns rows of float32 that belong to the caller.
template <typename Scalar>
nb::ndarray<nb::numpy, Scalar> Owned(std::vector<Scalar> values, std::size_t width) {
  auto* const own = new std::vector<Scalar>(std::move(values));
  nb::capsule owner(own,
                    [](void* data) noexcept { delete static_cast<std::vector<Scalar>*>(data); });
  return nb::ndarray<nb::numpy, Scalar>(own->data(), {own->size() / width, width},
                                        std::move(owner));
}

// Rows of numbers that Python gives.
class Rows {
 public:
  // `values` is an array of shape (rows, width), or (width,) for one row. Throws
  // std::invalid_argument.
  Rows(const char* name, const nb::object& values, std::size_t rows, std::size_t width)
      : array_(nb::cast<Numbers>(nb::module_::import_("numpy").attr("ascontiguousarray")(
            values, "dtype"_a = "float32"))),
        width_(width) {
    if (array_.size() != rows * width || array_.ndim() > 2 || array_.ndim() == 0 ||
        array_.shape(array_.ndim() - 1) != width) {
      throw std::invalid_argument("expected " + std::string(name) + " of shape (" +
                                  std::to_string(rows) + ", " + std::to_string(width) + "), got " +
                                  std::to_string(array_.size()) + " numbers");
    }
  }

  Eigen::Map<const Eigen::VectorXf> operator[](std::size_t row) const {
    return {array_.data() + row * width_, static_cast<Eigen::Index>(width_)};
  }

 private:
  using Numbers = nb::ndarray<const float, nb::c_contig, nb::device::cpu>;
  Numbers array_;
  std::size_t width_;
};

// A definition for `count` robots side by side.
class Definition {
 public:
  Definition(const std::string& file, robot::RobotSpec spec, std::size_t count)
      : spec_(std::move(spec)) {
    if (count == 0) throw std::invalid_argument("Definition: expected at least one robot, got 0");
    std::vector<policy::MotorName> motors;
    for (const robot::MotorSpec& motor : spec_.motors) {
      motors.push_back({.joint = motor.joint, .slot = motor.slot});
    }
    const policy::Interpreter one(policy::ReadDefinition(file), motors, spec_.name);
    interpreters_.assign(count, one);
  }

  const policy::Definition& own() const { return interpreters_.front().definition(); }
  const robot::RobotSpec& spec() const { return spec_; }
  std::size_t size() const { return interpreters_.size(); }

  // Of all motors: those that the policy does not move hold the standing pose.
  nb::ndarray<nb::numpy, double> PerMotor(double robot::MotorCommand::*field) const {
    std::vector<double> values;
    for (const robot::MotorCommand& motor : Commands(0)) values.push_back(motor.*field);
    const std::size_t motors = values.size();
    auto* const own = new std::vector<double>(std::move(values));
    nb::capsule owner(own,
                      [](void* data) noexcept { delete static_cast<std::vector<double>*>(data); });
    return nb::ndarray<nb::numpy, double>(own->data(), {motors}, std::move(owner));
  }

  void Begin(const std::vector<std::size_t>& robots, const nb::dict& state) {
    const State all(*this, state, nullptr);
    for (const std::size_t robot : robots) At(robot).Begin(all.Of(robot));
  }

  nb::ndarray<nb::numpy, float> Observe(const nb::dict& state, const nb::object& velocity,
                                        const std::optional<std::vector<std::size_t>>& robots) {
    const State all(*this, state, &velocity);
    std::vector<float> values;
    const auto observe = [&](std::size_t robot) {
      const Eigen::VectorXf& observation = At(robot).Observe(all.Of(robot));
      values.insert(values.end(), observation.begin(), observation.end());
    };
    if (robots) {
      for (const std::size_t robot : *robots) observe(robot);
    } else {
      for (std::size_t i = 0; i < size(); ++i) observe(i);
    }
    return Owned(std::move(values), Width(own()));
  }

  nb::ndarray<nb::numpy, double> Act(const nb::object& actions) {
    const Rows rows("actions", actions, size(), own().action.joints.size());
    std::vector<double> q;
    for (std::size_t i = 0; i < size(); ++i) {
      interpreters_[i].Act(rows[i]);
      for (const robot::MotorCommand& motor : Commands(i)) q.push_back(motor.q);
    }
    return Owned(std::move(q), spec_.motors.size());
  }

 private:
  // What robots sense, as Python has it.
  class State {
   public:
    State(const Definition& of, const nb::dict& state, const nb::object* velocity)
        : q_("q", Get(state, "q"), of.size(), of.spec_.motors.size()),
          dq_("dq", Get(state, "dq"), of.size(), of.spec_.motors.size()),
          quaternion_("quaternion", Get(state, "quaternion"), of.size(), 4),
          gyroscope_("gyroscope", Get(state, "gyroscope"), of.size(), 3) {
      if (velocity != nullptr) velocity_.emplace_back("velocity", *velocity, of.size(), 3);
    }

    policy::Sensed Of(std::size_t i) const {
      const auto w_x_y_z = quaternion_[i];
      policy::Sensed sensed{.q = q_[i], .dq = dq_[i]};
      sensed.R_WI = Eigen::Quaternionf(w_x_y_z[0], w_x_y_z[1], w_x_y_z[2], w_x_y_z[3]);
      sensed.w_WI_I = gyroscope_[i];
      if (!velocity_.empty()) sensed.velocity = velocity_.front()[i];
      return sensed;
    }

   private:
    static nb::object Get(const nb::dict& state, const char* name) {
      if (!state.contains(name)) {
        throw std::invalid_argument("state: expected q, dq, quaternion, gyroscope; there is no '" +
                                    std::string(name) + "'");
      }
      return state[name];
    }

    Rows q_, dq_, quaternion_, gyroscope_;
    std::vector<Rows> velocity_;
  };

  policy::Interpreter& At(std::size_t robot) {
    if (robot >= size()) {
      throw std::invalid_argument("Definition: there is no robot " + std::to_string(robot));
    }
    return interpreters_[robot];
  }

  std::vector<robot::MotorCommand> Commands(std::size_t i) const {
    std::vector<robot::MotorCommand> motors;
    for (std::size_t m = 0; m < spec_.motors.size(); ++m) {
      const robot::MotorSpec& motor = spec_.motors[m];
      motors.push_back({.q = spec_.standing.q[m], .kp = motor.hold_kp, .kd = motor.hold_kd});
    }
    for (const policy::Target& target : interpreters_[i].targets()) {
      motors[target.motor] = {.q = target.q, .kp = target.kp, .kd = target.kd};
    }
    return motors;
  }

  robot::RobotSpec spec_;
  std::vector<policy::Interpreter> interpreters_;
};

// A network with the check that it fits.
class BoundNetwork {
 public:
  BoundNetwork(const std::string& file, const Definition& definition)
      : network_(policy::MakeNetwork(policy::ReadTensors(file), file)) {
    policy::Definition named = definition.own();
    named.weights = file;
    policy::CheckWidths(named, network_);
  }

  nb::ndarray<nb::numpy, float> Run(const nb::object& observations) {
    const auto width = static_cast<std::size_t>(network_.inputs());
    const std::size_t rows = nb::len(observations);
    const Rows given("observations", observations, rows, width);
    std::vector<float> actions;
    for (std::size_t i = 0; i < rows; ++i) {
      const Eigen::VectorXf& action = network_.Run(given[i]);
      actions.insert(actions.end(), action.begin(), action.end());
    }
    return Owned(std::move(actions), static_cast<std::size_t>(network_.outputs()));
  }

 private:
  policy::Network network_;
};

robot::RobotSpec SpecOf(const nb::object& robot) {
  if (nb::isinstance<PythonRobot>(robot)) return nb::cast<const PythonRobot&>(robot).spec();
  const config::Layers layers = LayersOf({robot}, nb::tuple(), nb::dict(), std::nullopt);
  return config::LoadConfig(layers, config::DataDir()).robots[0].spec;
}

std::vector<std::string> JointNames(const Definition& d) {
  std::vector<std::string> names;
  for (const robot::MotorSpec& motor : d.spec().motors) names.push_back(motor.joint);
  return names;
}

}  // namespace

void BindPolicy(nb::module_& m) {
  nb::class_<Definition>(
      m, "Definition",
      "A policy's deploy.yaml for one or more robots side by side: what the network gets, and what "
      "its action does. The same code is in the motion service and in `understudy policy check`.")
      .def(nb::new_([](const nb::object& file, const nb::object& robot, std::size_t count) {
             return std::make_shared<Definition>(
                 nb::cast<std::string>(nb::module_::import_("os").attr("fspath")(file)),
                 SpecOf(robot), count);
           }),
           "file"_a, "robot"_a, "count"_a = 1,
           "robot: a Robot, or a name or path as of `understudy run`. Raises Error where the "
           "definition does not fit it, with key, what was expected and the nearest valid word.")
      .def("__len__", &Definition::size)
      .def_prop_ro(
          "step_dt", [](const Definition& d) { return static_cast<double>(d.own().step_dt); },
          "s between two steps of the policy")
      .def_prop_ro("joints", &JointNames, "names of all motors' joints, in the vendor's order")
      .def_prop_ro(
          "slots",
          [](const Definition& d) {
            std::vector<int> slots;
            for (const robot::MotorSpec& motor : d.spec().motors) slots.push_back(motor.slot);
            return slots;
          },
          "places of these motors in motor_state and motor_cmd")
      .def_prop_ro(
          "terms",
          [](const Definition& d) {
            std::vector<std::pair<std::string, std::size_t>> terms;
            for (const policy::Term& term : d.own().terms) {
              terms.emplace_back(term.row->name, Width(term, d.own()) * term.history);
            }
            return terms;
          },
          "observations in their order: name, and how many numbers with its history")
      .def_prop_ro(
          "observations", [](const Definition& d) { return Width(d.own()); },
          "how many numbers the network gets")
      .def_prop_ro(
          "actions", [](const Definition& d) { return d.own().action.joints.size(); },
          "how many it gives")
      .def_prop_ro(
          "velocity",
          [](const Definition& d) {
            std::vector<std::pair<float, float>> limits;
            for (const auto& [least, most] : d.own().velocity) limits.emplace_back(least, most);
            return limits;
          },
          "(least, most) of a command: forward, left m/s, turn rad/s")
      .def_prop_ro(
          "weights", [](const Definition& d) { return d.own().weights.string(); },
          "file of the weights, which need not be there")
      .def_prop_ro(
          "kp", [](const Definition& d) { return d.PerMotor(&robot::MotorCommand::kp); },
          nb::rv_policy::automatic,
          "N·m/rad, shape (motors,); motors without an action hold the standing pose")
      .def_prop_ro(
          "kd", [](const Definition& d) { return d.PerMotor(&robot::MotorCommand::kd); },
          nb::rv_policy::automatic, "N·m·s/rad, shape (motors,)")
      .def("begin", &Definition::Begin, "robots"_a, "state"_a,
           "Begins these robots anew, by their places: their last action is 0, their histories are "
           "as now. state: arrays by name as Batch.state: q, dq, quaternion, gyroscope.")
      .def("observe", &Definition::Observe, "state"_a, "velocity"_a, "robots"_a = nb::none(),
           "Makes a step of all robots, or of those at these places, and returns what the network "
           "gets: float32, shape (robots, observations). velocity: of each, forward, left m/s, "
           "turn rad/s, shape (robots, 3).")
      .def("act", &Definition::Act, "actions"_a,
           "Returns the angles to command, rad, shape (robots, motors), of actions of shape "
           "(robots, actions).");
  nb::class_<BoundNetwork>(m, "Network", "A policy's dense layers, as the motion service has them.")
      .def(nb::new_([](const nb::object& file, const Definition& definition) {
             return std::make_shared<BoundNetwork>(
                 nb::cast<std::string>(nb::module_::import_("os").attr("fspath")(file)),
                 definition);
           }),
           "file"_a, "definition"_a,
           "Reads safetensors. Raises Error where the widths do not fit the definition.")
      .def("__call__", &BoundNetwork::Run, "observations"_a,
           "Returns actions, float32, shape (robots, actions).");
}

}  // namespace understudy::python
