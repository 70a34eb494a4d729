#include "signals/signal_rows.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <Eigen/Geometry>

#include "judge/margin.h"
#include "robot/command_topics.h"
#include "wire/robot_topics.h"
#include "wire/roll_pitch_yaw.h"
#include "wire/rounded.h"

namespace understudy::signals {
namespace {

Eigen::Quaterniond Attitude(const TruthView& t) {
  return {t.base_position[3], t.base_position[4], t.base_position[5], t.base_position[6]};
}
double Angle(const TruthView& t, int axis) { return wire::RollPitchYaw(Attitude(t))[axis]; }
Eigen::Vector3d UpInWorld(const TruthView& t) { return Attitude(t) * Eigen::Vector3d::UnitZ(); }
// Of the base along its heading and to its left.
Eigen::Vector2d Level(const TruthView& t) {
  const double yaw = Angle(t, 2);
  return Eigen::Rotation2Dd(-yaw) * Eigen::Vector2d(t.base_velocity[0], t.base_velocity[1]);
}
Eigen::Quaterniond Attitude(const ObjectView& o) {
  return {o.position[3], o.position[4], o.position[5], o.position[6]};
}
double At(std::span<const double> values, std::size_t index) {
  return index < values.size() ? values[index] : judge::kUnknown;
}
double Sum(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum;
}

// As the message has it, in single precision.
double InLowState(const robot::RobotState& sample, std::size_t joint,
                  double robot::MotorReading::*value) {
  if (joint >= sample.motors.size()) return judge::kUnknown;
  return static_cast<float>(sample.motors[joint].*value);
}

double TorqueInLowState(const robot::RobotState& sample, std::size_t joint) {
  return InLowState(sample, joint, &robot::MotorReading::tau);
}

// Temperatures of motors as the messages of each family have them.
double HottestInGoLowState(const robot::RobotState& sample, std::size_t joint) {
  if (joint >= sample.motors.size()) return judge::kUnknown;
  const robot::MotorReading& motor = sample.motors[joint];
  return wire::Rounded<std::uint8_t>(std::max(motor.casing_c, motor.winding_c), 0, 127);
}
double WindingInHgLowState(const robot::RobotState& sample, std::size_t joint) {
  if (joint >= sample.motors.size()) return judge::kUnknown;
  return wire::Rounded<std::int16_t>(sample.motors[joint].winding_c);
}

using enum Signal::Source;

constexpr std::string_view kLowCmd = robot::kCommandTopicNames[robot::kLowCmdTopic];
constexpr std::string_view kLowState = wire::topic::kGoLowState.name;

constexpr SignalRow kRows[] = {
    {"base.x", "", "m", kTruth, "Position of the base in the world",
     [](const TruthView& t, std::size_t) { return t.base_position[0]; }},
    {"base.y", "", "m", kTruth, "Position of the base in the world",
     [](const TruthView& t, std::size_t) { return t.base_position[1]; }},
    {"base.height", "", "m", kTruth, "Height of the base over the origin of the world",
     [](const TruthView& t, std::size_t) { return t.base_position[2]; }},
    {"base.roll", "", "rad", kTruth, "Attitude of the base",
     [](const TruthView& t, std::size_t) { return Angle(t, 0); }},
    {"base.pitch", "", "rad", kTruth, "Attitude of the base",
     [](const TruthView& t, std::size_t) { return Angle(t, 1); }},
    {"base.yaw", "", "rad", kTruth, "Attitude of the base, from -π to π",
     [](const TruthView& t, std::size_t) { return Angle(t, 2); }},
    {"base.tilt", "", "rad", kTruth, "Angle between the z axes of base and world",
     [](const TruthView& t, std::size_t) {
       return std::acos(std::clamp(UpInWorld(t).z(), -1., 1.));
     }},
    {"base.forward", "", "m/s", kTruth, "Velocity of the base along its heading",
     [](const TruthView& t, std::size_t) { return Level(t).x(); }},
    {"base.left", "", "m/s", kTruth, "Velocity of the base to the left of its heading",
     [](const TruthView& t, std::size_t) { return Level(t).y(); }},
    {"base.up", "", "m/s", kTruth, "Velocity of the base upwards",
     [](const TruthView& t, std::size_t) { return t.base_velocity[2]; }},
    {"base.speed", "", "m/s", kTruth, "Horizontal speed of the base",
     [](const TruthView& t, std::size_t) {
       return std::hypot(t.base_velocity[0], t.base_velocity[1]);
     }},
    {"base.turn", "", "rad/s", kTruth, "Rate of turning about the world's z axis",
     [](const TruthView& t, std::size_t) {
       return (Attitude(t) *
               Eigen::Vector3d(t.base_velocity[3], t.base_velocity[4], t.base_velocity[5]))
           .z();
     }},
    {"torque", "JOINT", "N·m", kTruth, "Torque that acts at a joint",
     [](const TruthView& t, std::size_t joint) { return At(t.tau, joint); }},
    {.word = "torque_share",
     .argument = "JOINT",
     .unit = "",
     .source = kTruth,
     .says = "Size of that torque, as a share of the motor's torque_limit",
     .of = [](const TruthView& t, std::size_t joint) { return At(t.tau, joint); },
     .share = true},
    {"foot_force", "FOOT", "N", kTruth, "What presses on a foot",
     [](const TruthView& t, std::size_t foot) { return At(t.foot_force, foot); }},
    {"feet.force", "", "N", kTruth, "What presses on all feet",
     [](const TruthView& t, std::size_t) { return Sum(t.foot_force); }},
    {.word = "hand_force",
     .argument = "HAND",
     .unit = "N",
     .source = kTruth,
     .says = "What presses on a hand, on whichever of its links: `left` or `right`",
     .of = [](const TruthView& t, std::size_t hand) { return At(t.hand_force, hand); },
     .why_unknown = "is not in this recording, which is older"},
    {.word = "touch",
     .argument = "PAD",
     .unit = "N",
     .source = kTruth,
     .says = "What the cell of a hand's pad feels that feels most: `left_index_tip`",
     .of = [](const TruthView& t, std::size_t pad) { return At(t.touch, pad); },
     .why_unknown = "is not in this recording, which is older"},
    {"crane.tension", "", "N", kTruth, "Pull of the tether, 0 off the crane",
     [](const TruthView& t, std::size_t) { return t.crane_tension; }},
    {.word = "nearest_obstacle",
     .argument = "",
     .unit = "m",
     .source = kTruth,
     .says =
         "Distance of the nearest thing from the outline of the body, at the height of its base. "
         "At most 10 m. Recordings have it where their scenario asks for it",
     .of = [](const TruthView& t, std::size_t) { return t.nearest_obstacle; },
     .of_obstacles = true,
     .why_unknown = "was not asked for when this was recorded; rehearse measures it"},
    {.word = "object.x",
     .argument = "OBJECT",
     .unit = "m",
     .source = kTruth,
     .says = "Position of the middle of an object in the world",
     .of_object = [](const ObjectView& o) { return o.position[0]; }},
    {.word = "object.y",
     .argument = "OBJECT",
     .unit = "m",
     .source = kTruth,
     .says = "Position of the middle of an object in the world",
     .of_object = [](const ObjectView& o) { return o.position[1]; }},
    {.word = "object.height",
     .argument = "OBJECT",
     .unit = "m",
     .source = kTruth,
     .says = "Height of the middle of an object over the origin of the world",
     .of_object = [](const ObjectView& o) { return o.position[2]; }},
    {.word = "object.tilt",
     .argument = "OBJECT",
     .unit = "rad",
     .source = kTruth,
     .says = "Angle between the z axes of an object and the world; 0 as it was put there",
     .of_object =
         [](const ObjectView& o) {
           return std::acos(std::clamp((Attitude(o) * Eigen::Vector3d::UnitZ()).z(), -1., 1.));
         }},
    {.word = "object.speed",
     .argument = "OBJECT",
     .unit = "m/s",
     .source = kTruth,
     .says = "Speed of the middle of an object",
     .of_object =
         [](const ObjectView& o) {
           return std::hypot(o.velocity[0], o.velocity[1], o.velocity[2]);
         }},
    {.word = "q",
     .argument = "JOINT",
     .unit = "rad",
     .source = kField,
     .says = "Angle of a joint in rt/lowstate",
     .of_sample = [](const robot::RobotState& s,
                     std::size_t joint) { return InLowState(s, joint, &robot::MotorReading::q); },
     .topic = kLowState,
     .field = "q"},
    {.word = "dq",
     .argument = "JOINT",
     .unit = "rad/s",
     .source = kField,
     .says = "Rate of a joint in rt/lowstate",
     .of_sample = [](const robot::RobotState& s,
                     std::size_t joint) { return InLowState(s, joint, &robot::MotorReading::dq); },
     .topic = kLowState,
     .field = "dq"},
    {.word = "tau_est",
     .argument = "JOINT",
     .unit = "N·m",
     .source = kField,
     .says = "Torque of a joint in rt/lowstate",
     .of_sample = TorqueInLowState,
     .topic = kLowState,
     .field = "tau_est"},
    {.word = "tau_est_share",
     .argument = "JOINT",
     .unit = "",
     .source = kField,
     .says = "Size of that torque, as a share of the motor's torque_limit",
     .of_sample = TorqueInLowState,
     .topic = kLowState,
     .field = "tau_est",
     .share = true},
    {.word = "temperature",
     .argument = "JOINT",
     .unit = "°C",
     .source = kField,
     .says = "Temperature of a motor in rt/lowstate; in the hg family that of its winding",
     .of_sample = HottestInGoLowState,
     .of_hg_sample = WindingInHgLowState,
     .topic = kLowState,
     .field = "temperature"},
    {.word = "first_jump",
     .argument = "",
     .unit = "rad",
     .source = kFirstJump,
     .says = "Largest difference between an angle that the first command of rt/lowcmd asks for and "
             "the joint's in rt/lowstate; of a simulated robot the first command that is taken, of "
             "a recording without its events the first that asks for an angle; unknown before",
     .topic = kLowCmd},
    {"rate", "TOPIC", "Hz", kRate,
     "Messages of a topic in the last second; unknown until a second after the first one"},
    {"gap", "TOPIC", "s", kGap,
     "Time since the last message of a topic; unknown before the first one"},
    {"count", "EVENT", "", kEventCount, "Number of events of a kind so far"},
    {.word = "refusals",
     .argument = "",
     .unit = "",
     .source = kEventCount,
     .says = "Commands refused so far: count(refused)",
     .topic = "refused"},
    {.word = "state",
     .argument = "",
     .unit = "",
     .source = kEventField,
     .says = "Of the motion service, by the vendor's id: motion.state",
     .topic = "motion",
     .field = "state"},
    {.word = "gate",
     .argument = "",
     .unit = "",
     .source = kEventField,
     .says = "State of the gate of rt/lowcmd: gate.state",
     .topic = "gate",
     .field = "state"},
    {.word = "service",
     .argument = "",
     .unit = "",
     .source = kEventField,
     .says = "Motion service that is on: motion_service.service",
     .topic = "motion_service",
     .field = "service"},
    {.word = "program.exit_code",
     .argument = "",
     .unit = "",
     .source = kEventField,
     .says = "Of the program under test: program_end.code",
     .topic = "program_end",
     .field = "code"},
};

}  // namespace

std::span<const SignalRow> SignalRows() { return kRows; }

std::vector<std::string> SignalWords() {
  std::vector<std::string> words;
  for (const SignalRow& row : kRows) {
    words.push_back(std::string(row.word) +
                    (row.argument.empty() ? "" : "(" + std::string(row.argument) + ")"));
  }
  return words;
}

std::string SignalsReference() {
  constexpr std::string_view kOrigins[] = {"truth", "messages", "events"};
  std::string text = "| signal | unit | from | is |\n|---|---|---|---|\n";
  const std::vector<std::string> words = SignalWords();
  for (std::size_t i = 0; i < std::size(kRows); ++i) {
    const SignalRow& row = kRows[i];
    text += "| `" + words[i] + "` | " + std::string(row.unit) + " | " +
            std::string(kOrigins[static_cast<std::size_t>(Signal::OriginOf(row.source))]) + " | " +
            std::string(row.says) + " |\n";
  }
  return text;
}

}  // namespace understudy::signals
