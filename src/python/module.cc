// The module understudy._understudy: worlds and robots without a network, for Python.
#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "config/data_dir.h"
#include "config/load.h"
#include "config/robot_file.h"
#include "mjcf/saved_model.h"
#include "physics/world_model.h"
#include "python/arguments.h"
#include "python/batch_module.h"
#include "python/policy_module.h"
#include "python/python_world.h"
#include "robot/hand_law.h"

namespace understudy::python {
namespace {

namespace nb = nanobind;
using nb::literals::operator""_a;

using Array = nb::ndarray<nb::numpy, double>;
constexpr auto kOwn = nb::rv_policy::automatic;  // an array owns its values

// Returns an array of its own with these values.
template <typename Values>
Array ArrayOf(const Values& values) {
  auto* const own = new std::vector<double>(std::begin(values), std::end(values));
  nb::capsule owner(own,
                    [](void* data) noexcept { delete static_cast<std::vector<double>*>(data); });
  return Array(own->data(), {own->size()}, std::move(owner));
}

Array ArrayOf(const Eigen::Quaterniond& q) {
  return ArrayOf(std::array{q.w(), q.x(), q.y(), q.z()});
}
Array ArrayOf(const Eigen::Vector3d& v) { return ArrayOf(std::array{v.x(), v.y(), v.z()}); }

// Of a field of each motor.
template <typename Field>
Array ArrayOf(const std::vector<robot::MotorReading>& motors, Field robot::MotorReading::*field) {
  std::vector<double> values;
  for (const robot::MotorReading& motor : motors) {
    values.push_back(static_cast<double>(motor.*field));
  }
  return ArrayOf(values);
}

void Command(PythonRobot& robot, const nb::object& q, const nb::object& dq, const nb::object& tau,
             const nb::object& kp, const nb::object& kd, bool enabled, double weight,
             const std::string& topic) {
  const std::size_t number = robot.TopicOf(topic);
  robot::RobotCommand command = robot.CommandOf(number);
  for (robot::MotorCommand& motor : command.motors) motor.enabled = enabled;
  command.weight = weight;
  Fill({&q, &dq, &tau, &kp, &kd}, command.motors.size(), command.motors);
  robot.world().port(robot.index()).Give(number, std::move(command));
}

void Step(PythonWorld& world, double seconds) {
  const int steps = world.StepsOf(seconds);
  const nb::gil_scoped_release release;
  world.simulation().Step(steps);
}

// The simulation's truth of a robot: read when asked for, of the last step.
struct Truth {
  PythonRobot robot;
};

std::vector<std::string> Joints(const std::vector<robot::MotorSpec>& motors) {
  std::vector<std::string> names;
  for (const robot::MotorSpec& motor : motors) names.push_back(motor.joint);
  return names;
}

std::shared_ptr<PythonWorld> MakeWorld(const config::Layers& layers) {
  const nb::gil_scoped_release release;
  return std::make_shared<PythonWorld>(layers);
}

void BindState(nb::module_& m) {
  using robot::MotorReading;
  using robot::RobotState;
  nb::class_<RobotState>(m, "State", "What LowState tells: the last one, with noise and faults.")
      .def_ro("tick", &RobotState::tick_ms, "ms of simulated time since the robot was switched on")
      .def_prop_ro(
          "q", [](const RobotState& s) { return ArrayOf(s.motors, &MotorReading::q); }, kOwn,
          "rad, shape (motors,)")
      .def_prop_ro(
          "dq", [](const RobotState& s) { return ArrayOf(s.motors, &MotorReading::dq); }, kOwn,
          "rad/s, shape (motors,)")
      .def_prop_ro(
          "tau_est", [](const RobotState& s) { return ArrayOf(s.motors, &MotorReading::tau); },
          kOwn, "N·m of the motors, before joint friction, shape (motors,)")
      .def_prop_ro(
          "temperature",
          [](const RobotState& s) { return ArrayOf(s.motors, &MotorReading::winding_c); }, kOwn,
          "degrees Celsius of the windings, shape (motors,)")
      .def_prop_ro(
          "lost", [](const RobotState& s) { return ArrayOf(s.motors, &MotorReading::lost); }, kOwn,
          "samples in which a motor did not answer, shape (motors,)")
      .def_prop_ro(
          "quaternion", [](const RobotState& s) { return ArrayOf(s.imu.R_WI); }, kOwn,
          "attitude of the inertial unit in the world: w, x, y, z")
      .def_prop_ro(
          "gyroscope", [](const RobotState& s) { return ArrayOf(s.imu.w_WI_I); }, kOwn,
          "rad/s in the unit's axes, shape (3,)")
      .def_prop_ro(
          "accelerometer", [](const RobotState& s) { return ArrayOf(s.imu.f_WI_I); }, kOwn,
          "specific force, m/s² in the unit's axes, shape (3,): at rest +g upward")
      .def_prop_ro(
          "foot_force", [](const RobotState& s) { return ArrayOf(s.foot_force); }, kOwn,
          "N as read, shape (feet,); a quadruped's are FR, FL, RR, RL")
      .def_prop_ro(
          "voltage", [](const RobotState& s) { return s.battery.voltage; }, "V of the pack")
      .def_prop_ro(
          "current", [](const RobotState& s) { return s.battery.current; },
          "A of the pack, negative while it gives")
      .def_prop_ro(
          "soc", [](const RobotState& s) { return s.battery.soc; }, "charge, 0 to 1");
}

void BindTruth(nb::module_& m) {
  const auto spans = [](std::span<const double> all, std::size_t from, std::size_t to) {
    if (all.empty()) return Array();
    return ArrayOf(all.subspan(from, to - from));
  };
  nb::class_<Truth>(m, "Truth",
                    "What the simulation knows, of the last step. A base that is fixed has no "
                    "quaternion and no velocity: their arrays are empty.")
      .def_prop_ro(
          "position", [](const Truth& t) { return ArrayOf(t.robot.body().base().p_WB); }, kOwn,
          "m, of the base in the world, shape (3,)")
      .def_prop_ro(
          "quaternion",
          [spans](const Truth& t) { return spans(t.robot.body().base_position(), 3, 7); }, kOwn,
          "attitude of the base in the world: w, x, y, z")
      .def_prop_ro(
          "velocity", [](const Truth& t) { return ArrayOf(t.robot.body().base().v_WB_W); }, kOwn,
          "m/s, of the base in the world's axes, shape (3,)")
      .def_prop_ro(
          "turning_rate",
          [spans](const Truth& t) { return spans(t.robot.body().base_velocity(), 3, 6); }, kOwn,
          "rad/s, of the base in its own axes, shape (3,)")
      .def_prop_ro(
          "q", [](const Truth& t) { return ArrayOf(t.robot.body().q()); }, kOwn,
          "rad, shape (motors,)")
      .def_prop_ro(
          "dq", [](const Truth& t) { return ArrayOf(t.robot.body().dq()); }, kOwn,
          "rad/s, shape (motors,)")
      .def_prop_ro(
          "torque", [](const Truth& t) { return ArrayOf(t.robot.part().torque()); }, kOwn,
          "N·m at the joints, shape (motors,)")
      .def_prop_ro(
          "tilt", [](const Truth& t) { return t.robot.body().tilt(); },
          "rad between the base's up and the world's")
      .def_prop_ro(
          "foot_force",
          [](const Truth& t) {
            std::vector<double> force(t.robot.spec().feet.size());
            t.robot.body().FootForces(force);
            return ArrayOf(force);
          },
          kOwn, "N of the contacts, shape (feet,)")
      .def_prop_ro(
          "hand_force",
          [](const Truth& t) {
            std::vector<double> force(robot::HandNames(t.robot.spec()).size());
            t.robot.body().HandForces(force);
            return ArrayOf(force);
          },
          kOwn, "N of the contacts of each hand, shape (hands,): left before right");
}

// Compiles the robot's world anew, with what was drawn for it, for the package mujoco.
nb::object MujocoModel(const PythonRobot& robot) {
  config::Config config = robot.world().simulation().config();
  const assembly::MadePhysics made = assembly::MakePhysics(&config);
  const mjcf::SavedModel saved = mjcf::SaveModel(made.world.robot().model(), physics::kClampName);
  nb::dict files;
  for (const mjcf::SavedField& field : saved.fields) {
    files[field.file.c_str()] = nb::bytes(field.bytes.data(), field.bytes.size());
  }
  return nb::module_::import_("mujoco").attr("MjModel").attr("from_xml_string")(saved.xml, files);
}

nb::list Events(PythonRobot& robot) {
  nb::list events;
  const nb::object loads = nb::module_::import_("json").attr("loads");
  for (const emulator::ToldEvent& told : robot.world().TakeEvents(robot.index())) {
    nb::dict event;
    event["time"] = told.event.time;
    event["kind"] = std::string(told.kind());
    event["text"] = told.text();
    event["detail"] = loads(told.detail().dump());
    events.append(event);
  }
  return events;
}

nb::dict Damage(const PythonRobot& robot) {
  const robot::DamageTotals& totals = robot.part().damage();
  nb::dict damage;
  damage["time"] = totals.time;
  damage["energy"] = totals.energy;
  damage["peak_current"] = totals.peak_current;
  damage["shock"] = totals.shock;
  damage["worst_tilt"] = totals.worst_tilt;
  damage["falls"] = totals.falls;
  const auto motors = [&](const char* name, double robot::MotorDamage::*field) {
    std::vector<double> values;
    for (const robot::MotorDamage& motor : totals.motors) values.push_back(motor.*field);
    damage[name] = ArrayOf(values);
  };
  motors("at_torque_limit", &robot::MotorDamage::at_torque_limit);
  motors("at_speed_limit", &robot::MotorDamage::at_speed_limit);
  motors("tripped", &robot::MotorDamage::tripped);
  motors("hottest", &robot::MotorDamage::hottest_c);
  motors("hardest_stop", &robot::MotorDamage::hardest_stop);
  motors("largest_jump", &robot::MotorDamage::largest_jump);
  return damage;
}

void BindRobot(nb::module_& m) {
  nb::class_<PythonRobot>(m, "Robot", "One robot of a world, which it keeps alive.")
      .def(nb::new_([](const nb::object& name, const nb::object& files, const nb::dict& sets,
                       const std::optional<int>& seed) {
             return std::make_shared<PythonRobot>(MakeWorld(LayersOf({name}, files, sets, seed)),
                                                  0);
           }),
           "name"_a, nb::kw_only(), "config"_a = nb::tuple(), "set"_a = nb::dict(),
           "seed"_a = nb::none(), "Makes a World with this one robot, from the same arguments.")
      .def_prop_ro("name", [](const PythonRobot& r) { return r.spec().name; })
      .def_prop_ro(
          "joints", [](const PythonRobot& r) { return Joints(r.spec().motors); },
          "names of the motors' joints, in the vendor's order")
      .def_prop_ro(
          "standing", [](const PythonRobot& r) { return ArrayOf(r.spec().standing.q); }, kOwn,
          "rad, joint angles of the standing pose, shape (motors,)")
      .def_prop_ro("world", [](const PythonRobot& r) { return r.world().shared_from_this(); })
      .def_prop_ro(
          "state", [](const PythonRobot& r) { return r.lowstate(); },
          "The last LowState. Raises RuntimeError before the first step.")
      .def_prop_ro("truth", [](const PythonRobot& r) { return Truth{r}; })
      .def_prop_ro(
          "time", [](const PythonRobot& r) { return r.world().simulation().world().time(); },
          "s of simulated time")
      .def_prop_ro("damage", &Damage,
                   "what the run would have done to the robot so far, as "
                   "`understudy ctl damage` has it")
      .def("command", &Command, nb::kw_only(), "q"_a = 0.0, "dq"_a = nb::none(),
           "tau"_a = nb::none(), "kp"_a = 0.0, "kd"_a = 0.0, "enabled"_a = true, "weight"_a = 1.0,
           "topic"_a = "rt/lowcmd",
           "Sends one command to all motors of a topic: a number, or an array of shape (motors,), "
           "in the order of `joints`.\n\nq [rad], dq [rad/s], tau [N·m], kp [N·m/rad], kd "
           "[N·m·s/rad]. It acts in the next step and is judged as a LowCmd on the bus. `weight` "
           "is that of rt/arm_sdk and rt/hand_sdk. dq and tau that are not given are 0, but of "
           "hands that follow "
           "goals: a brainco goes there at full speed, an inspire_ftp at the speed and with the "
           "most torque of the command before. Raises ValueError for another shape or topic.")
      .def(
          "step", [](PythonRobot& r, double seconds) { Step(r.world(), seconds); },
          "seconds"_a = 0.001, "Steps the whole world by so many seconds of simulated time.")
      .def(
          "begin",
          [](PythonRobot& r, int seed) {
            const nb::gil_scoped_release release;
            r.world().Begin(seed);
          },
          "seed"_a, "Begins an episode of the whole world: World.begin.")
      .def("mujoco_model", &MujocoModel,
           "Returns the world's very model as a mujoco.MjModel, with what was drawn for it, as "
           "`understudy export mjcf` writes it. Needs the package mujoco (the extra of that name). "
           "No world may be made in another thread meanwhile.")
      .def("take_events", &Events,
           "Returns the events since the last call: dicts with time [s], "
           "kind, text and detail, as recordings have them.")
      .def(
          "request",
          [](const PythonRobot& r, const std::string& name, const nb::kwargs& values) {
            r.Request(name, JsonOf(values));
          },
          "name"_a, "values"_a,
          "Carries out a request of `understudy ctl` on this robot before the next step, such as "
          "request('push', impulse=[0, 8, 0]); no time passes. docs/reference/requests.md has "
          "names and values. Raises Error with the reason if it is refused.");
}

void BindWorld(nb::module_& m) {
  nb::class_<PythonWorld>(m, "World", "Robots in one world, in this process.")
      .def(nb::new_([](const nb::args& robots, const nb::object& files, const nb::dict& sets,
                       const std::optional<int>& seed) {
             return MakeWorld(LayersOf({robots.begin(), robots.end()}, files, sets, seed));
           }),
           "robots"_a, nb::kw_only(), "config"_a = nb::tuple(), "set"_a = nb::dict(),
           "seed"_a = nb::none(),
           "Makes a world of robots: names as of `understudy run`, or paths of YAML files.\n\n"
           "config: the path of a YAML file, or several, as --config. set: values by dotted key, "
           "as --set. seed: "
           "of the sensors' noise and of all that is drawn at random.\n\nTime is 0, the robots are "
           "in their start poses, and there "
           "is no State before the first step. Raises Error, whose line names the file, the key, "
           "what was expected and the nearest valid word.")
      .def_prop_ro(
          "time", [](PythonWorld& w) { return w.simulation().world().time(); },
          "s of simulated time")
      .def_prop_ro(
          "timestep", [](PythonWorld& w) { return w.simulation().config().physics.timestep; },
          "s of a step")
      .def_prop_ro("robots",
                   [](const std::shared_ptr<PythonWorld>& w) {
                     std::vector<PythonRobot> robots;
                     for (std::size_t i = 0; i < w->simulation().world().robot_count(); ++i) {
                       robots.emplace_back(w, i);
                     }
                     return robots;
                   })
      .def_prop_ro(
          "notes",
          [](PythonWorld& w) {
            std::vector<std::string> notes;
            for (const assembly::Note& note : w.simulation().notes()) {
              notes.push_back(note.text);
            }
            return notes;
          },
          "warnings about the models, and what was drawn at random")
      .def(
          "begin",
          [](PythonWorld& w, int seed, const std::vector<assembly::Place>& at) {
            const nb::gil_scoped_release release;
            w.Begin(seed, at);
          },
          "seed"_a, "at"_a = std::vector<assembly::Place>(),
          "Begins an episode: bit for bit as a new World of that seed, but without compiling. "
          "Time is 0, and there is no State before the first step. Events that nobody has taken "
          "are gone. `at` has x, y [m] and yaw [rad] of the first robots, in place of their "
          "start.at; a fixed base stays.")
      .def("step", &Step, "seconds"_a = 0.001,
           "Steps by so many seconds of simulated time, a whole number of steps. Other threads of "
           "Python run meanwhile. Raises RuntimeError when the physics diverges.")
      .def(
          "config",
          [](PythonWorld& w) { return config::PrintConfig(w.simulation().config(), false); },
          "The configuration in effect, as YAML.");
}

}  // namespace

NB_MODULE(_understudy, m) {
  nb::exception<SetupError>(m, "Error", PyExc_RuntimeError);
  BindState(m);
  BindTruth(m);
  BindWorld(m);
  BindRobot(m);
  BindBatch(m);
  BindPolicy(m);
  m.def(
      "robot_names", [] { return config::RobotNames(config::DataDir()); },
      "The names of the robots that this installation has.");
  m.def("_set_data_dir", [](const std::string& path) { config::PackageDataDir() = path; });
}

}  // namespace understudy::python
