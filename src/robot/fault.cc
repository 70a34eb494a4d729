#include "robot/fault.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace understudy::robot {
namespace {

constexpr double kPi = 3.141592653589793;

MotorEffects& Motor(const ActingFault& fault, Effects* effects) {
  return effects->motors[fault.element];
}
EncoderEffects& Encoder(const ActingFault& fault, Effects* effects) {
  return effects->encoders[fault.element];
}
ImuEffects& Imu(const ActingFault& fault, Effects* effects) { return effects->imus[fault.element]; }
FootEffects& Foot(const ActingFault& fault, Effects* effects) {
  return effects->feet[fault.element];
}
LinkEffects& Link(const ActingFault& fault, Effects* effects) {
  return effects->links[fault.element];
}
ServiceEffects& ServiceOf(const ActingFault& fault, Effects* effects) {
  return effects->services[fault.element];
}
BusEffects& Bus(const ActingFault& fault, Effects* effects) {
  return effects->buses[fault.element];
}

// What a message takes of which all take `mean` s in the mean: few much longer, as in a queue.
// *assumed*
double Wait(const ActingFault& fault, double mean) { return -mean * std::log1p(-fault.chance); }

// Only the go family's messages report mainboard and fans.
bool TellsOfBoard(const RobotSpec& spec) { return spec.family == WireFamily::kGo; }

// What is left of a share that goes down to `by`.
double Left(const ActingFault& fault) { return 1 - fault.grown * (1 - fault.by); }

using F = const ActingFault&;
using E = Effects*;

// A new row stands at the end: what FaultBank draws for a fault goes by the place of its row, so
// that the seeded runs of the others stay as they were. Documents sort the rows by component.
constexpr auto kKinds = std::to_array<FaultKind>({
    {.of = Component::kMotor,
     .name = "limp",
     .does = "It gives no torque, as a drive without current; it goes on answering",
     .act = [](F f, E e) { Motor(f, e).torque_share = 0; }},
    {.of = Component::kMotor,
     .name = "off",
     .does = "It gives no torque and does not answer: its readings stay as they were, its lost "
             "packets count, its link is reported broken",
     .act =
         [](F f, E e) {
           Motor(f, e).torque_share = 0;
           Motor(f, e).silent = true;
         }},
    {.of = Component::kMotor,
     .name = "weak",
     .does = "It gives only that share of its torque, for the current and the heat of all of it",
     .low = 0,
     .high = 1,
     .otherwise = 0.5,
     .act = [](F f, E e) { Motor(f, e).torque_share *= Left(f); }},
    {.of = Component::kMotor,
     .name = "jammed",
     .does = "Its joint does not turn, as with a seized gear; it goes on pushing and gets warm",
     .act = [](F f, E e) { Motor(f, e).jammed = true; }},
    {.of = Component::kMotor,
     .name = "dragging",
     .does = "Friction in its gear takes that much of its torque",
     .unit = "N·m",
     .low = 0,
     .high = 500,
     .otherwise = 3,
     .act = [](F f, E e) { Motor(f, e).drag += f.by * f.grown; }},
    {.of = Component::kMotor,
     .name = "hot",
     .does = "Winding and casing are that much hotter than its work makes them",
     .unit = "°C",
     .low = 0,
     .high = 200,
     .otherwise = 60,
     .act = [](F f, E e) { Motor(f, e).heat_c += f.by * f.grown; }},
    {.of = Component::kEncoder,
     .name = "off",
     .does = "It reads 0, and the motor tells its encoder's error",
     .act = [](F f, E e) { Encoder(f, e).dead = true; }},
    {.of = Component::kEncoder,
     .name = "stuck",
     .does = "It goes on reading the angle it read, and no rate",
     .act = [](F f, E e) { Encoder(f, e).stuck = true; }},
    {.of = Component::kEncoder,
     .name = "garbage",
     .does = "It reads any angle within a turn either way, another each time, and the motor tells "
             "its encoder's error",
     .act = [](F f, E e) { Encoder(f, e).garbage = true; }},
    {.of = Component::kEncoder,
     .name = "offset",
     .does = "It reads that much more than there is, as after a wrong calibration",
     .unit = "rad",
     .low = -kPi,
     .high = kPi,
     .otherwise = 0.05,
     .act = [](F f, E e) { Encoder(f, e).offset += f.by * f.grown; }},
    {.of = Component::kEncoder,
     .name = "drifting",
     .does = "What it reads goes away from what there is at that rate",
     .unit = "rad/s",
     .low = -1,
     .high = 1,
     .otherwise = 0.002,
     .act = [](F f, E e) { Encoder(f, e).offset += f.by * f.age; }},
    {.of = Component::kEncoder,
     .name = "noisy",
     .does = "What it reads is spread with that standard deviation",
     .unit = "rad",
     .low = 0,
     .high = 1,
     .otherwise = 0.005,
     .act = [](F f, E e) { Encoder(f, e).noise += f.by * f.grown; }},
    {.of = Component::kImu,
     .name = "off",
     .does = "It reads no rate, no acceleration and no turn",
     .act = [](F f, E e) { Imu(f, e).dead = true; }},
    {.of = Component::kImu,
     .name = "stuck",
     .does = "It goes on reading what it read",
     .act = [](F f, E e) { Imu(f, e).stuck = true; }},
    {.of = Component::kImu,
     .name = "offset",
     .does = "Its rates about all axes are off by that much",
     .unit = "rad/s",
     .low = -1,
     .high = 1,
     .otherwise = 0.02,
     .act = [](F f, E e) { Imu(f, e).rate += f.by * f.grown; }},
    {.of = Component::kImu,
     .name = "tilted",
     .does = "It is mounted turned by that much about its y axis, and all that it reads with it",
     .unit = "rad",
     .low = -kPi / 2,
     .high = kPi / 2,
     .otherwise = 0.05,
     .act = [](F f, E e) { Imu(f, e).tilt += f.by * f.grown; }},
    {.of = Component::kImu,
     .name = "drifting",
     .does = "Its heading turns away at that rate",
     .unit = "rad/s",
     .low = -1,
     .high = 1,
     .otherwise = 0.01,
     .act = [](F f, E e) { Imu(f, e).turn += f.by * f.age; }},
    {.of = Component::kImu,
     .name = "noisy",
     .does = "Its rates are spread with that standard deviation, accelerations in m/s² with ten "
             "times as much",
     .unit = "rad/s",
     .low = 0,
     .high = 10,
     .otherwise = 0.1,
     .act = [](F f, E e) { Imu(f, e).noise += f.by * f.grown; }},
    {.of = Component::kFoot,
     .name = "off",
     .does = "It reads no force",
     .act = [](F f, E e) { Foot(f, e).share = 0; }},
    {.of = Component::kFoot,
     .name = "stuck",
     .does = "It goes on reading the force it read",
     .act = [](F f, E e) { Foot(f, e).stuck = true; }},
    {.of = Component::kFoot,
     .name = "weak",
     .does = "It reads only that share of the force",
     .low = 0,
     .high = 1,
     .otherwise = 0.5,
     .act = [](F f, E e) { Foot(f, e).share *= Left(f); }},
    {.of = Component::kFoot,
     .name = "offset",
     .does = "It reads that much more than there is",
     .unit = "N",
     .low = -1000,
     .high = 1000,
     .otherwise = 20,
     .act = [](F f, E e) { Foot(f, e).offset += f.by * f.grown; }},
    {.of = Component::kBattery,
     .name = "weak",
     .does = "Its internal resistance is that many times as great, as of an old or a cold pack",
     .low = 1,
     .high = 50,
     .otherwise = 3,
     .act = [](F f, E e) { e->battery.resistance *= 1 + f.grown * (f.by - 1); }},
    {.of = Component::kBattery,
     .name = "empty",
     .does = "It has at most that charge; what went is gone",
     .low = 0,
     .high = 1,
     .otherwise = 0.05,
     .act = [](F f, E e) { e->battery.most_charge = std::min(e->battery.most_charge, Left(f)); }},
    {.of = Component::kRemote,
     .name = "off",
     .does = "Nothing of the remote controller is received",
     .act = [](F, E e) { e->remote_off = true; }},
    {.of = Component::kTopic,
     .name = "off",
     .does = "Nothing is sent or received on it",
     .act = [](F f, E e) { Link(f, e).drops = true; }},
    {.of = Component::kTopic,
     .name = "lost",
     .does = "That share of its messages is lost",
     .low = 0,
     .high = 1,
     .otherwise = 0.1,
     .act = [](F f, E e) { Link(f, e).drops |= f.chance < f.by * f.grown; }},
    {.of = Component::kTopic,
     .name = "doubled",
     .does = "That share of its messages comes twice",
     .low = 0,
     .high = 1,
     .otherwise = 0.1,
     .act = [](F f, E e) { Link(f, e).doubles |= f.chance < f.by * f.grown; }},
    {.of = Component::kTopic,
     .name = "damaged",
     .does = "That share of its messages comes with a wrong crc; of a topic without one it is lost",
     .low = 0,
     .high = 1,
     .otherwise = 0.1,
     .act = [](F f, E e) { Link(f, e).damages |= f.chance < f.by * f.grown; }},
    {.of = Component::kTopic,
     .name = "reordered",
     .does = "That share of its messages comes after the one that follows it",
     .low = 0,
     .high = 1,
     .otherwise = 0.1,
     .act = [](F f, E e) { Link(f, e).reorders |= f.chance < f.by * f.grown; }},
    {.of = Component::kTopic,
     .name = "delayed",
     .does = "Its messages come that much later",
     .unit = "s",
     .low = 0,
     .high = 1,
     .otherwise = 0.05,
     .act = [](F f, E e) { Link(f, e).delay += f.by * f.grown; }},
    {.of = Component::kTopic,
     .name = "jittery",
     .does = "Its messages come later by times that are drawn from an exponential distribution of "
             "that mean; none overtakes another",
     .unit = "s",
     .low = 0,
     .high = 0.2,
     .otherwise = 0.005,
     .act = [](F f, E e) { Link(f, e).delay += Wait(f, f.by * f.grown); }},
    {.of = Component::kService,
     .name = "off",
     .does = "It neither acts nor answers, as a program that has died; calls time out",
     .act = [](F f, E e) { ServiceOf(f, e).off = true; }},
    {.of = Component::kService,
     .name = "slow",
     .does = "It acts at once and answers that much later, of wall time",
     .unit = "s",
     .low = 0,
     .high = 60,
     .otherwise = 1,
     .act = [](F f, E e) { ServiceOf(f, e).delay += f.by * f.grown; }},
    {.of = Component::kBus,
     .name = "off",
     .does = "Nothing goes over it: its motors give no torque and do not answer",
     .act =
         [](F f, E e) {
           Bus(f, e).drops = true;
           for (const std::size_t motor : f.motors) {
             e->motors[motor].torque_share = 0;
             e->motors[motor].silent = true;
           }
         }},
    {.of = Component::kBus,
     .name = "lost",
     .does = "That share of its packets is lost: its motors go on with the command before, their "
             "readings stay as they were and their lost packets count",
     .low = 0,
     .high = 1,
     .otherwise = 0.1,
     .act =
         [](F f, E e) {
           if (f.chance >= f.by * f.grown) return;
           Bus(f, e).drops = true;
           for (const std::size_t motor : f.motors) e->motors[motor].unheard = true;
         }},
    {.of = Component::kBus,
     .name = "slow",
     .does = "Commands come to its motors that much later",
     .unit = "s",
     .low = 0,
     .high = 0.2,
     .otherwise = 0.01,
     .act = [](F f, E e) { Bus(f, e).delay += f.by * f.grown; }},
    {.of = Component::kBus,
     .name = "jittery",
     .does = "Commands come to its motors later by times that are drawn from an exponential "
             "distribution of that mean; none overtakes another",
     .unit = "s",
     .low = 0,
     .high = 0.2,
     .otherwise = 0.002,
     .act = [](F f, E e) { Bus(f, e).delay += Wait(f, f.by * f.grown); }},
    {.of = Component::kFan,
     .name = "off",
     .does =
         "It does not turn: the mainboard gets warmer, and it is reported stalled where the vendor "
         "has a bit for it",
     .act = [](F f, E e) { e->fans[f.element].share = 0; }},
    {.of = Component::kFan,
     .name = "weak",
     .does = "It turns at only that share of its speed, and cools as much less",
     .low = 0,
     .high = 1,
     .otherwise = 0.5,
     .act = [](F f, E e) { e->fans[f.element].share *= Left(f); }},
    {.of = Component::kMainboard,
     .name = "off",
     .does = "Nothing computes: motors limp, nothing sent, read or answered. Once it works again "
             "the robot boots as from its switch",
     .act = [](F, E e) { e->board.dead = true; }},
    {.of = Component::kMainboard,
     .name = "hot",
     .does = "It is that much hotter than its work makes it",
     .unit = "°C",
     .low = 0,
     .high = 100,
     .otherwise = 30,
     .act = [](F f, E e) { e->board.heat_c += f.by * f.grown; },
     .fits = TellsOfBoard},
    {.of = Component::kMcu,
     .name = "off",
     .does = "It does not answer: temperatures of the mainboard and speeds of fans stay as they "
             "were, and that is reported",
     .act = [](F, E e) { e->board.mute = true; },
     .fits = TellsOfBoard},
    {.of = Component::kLidar,
     .name = "off",
     .does = "Nothing of it is sent, as with its cable pulled",
     .act = [](F, E e) { e->lidar.dead = true; }},
    {.of = Component::kLidar,
     .name = "blind",
     .does = "No echo comes back, and its state reports an error of its cloud",
     .act = [](F, E e) { e->lidar.blind = true; }},
    {.of = Component::kLidar,
     .name = "lost",
     .does = "That share of its echoes is lost",
     .low = 0,
     .high = 1,
     .otherwise = 0.1,
     .act = [](F f, E e) { e->lidar.lost = 1 - (1 - e->lidar.lost) * (1 - f.by * f.grown); }},
    {.of = Component::kLidar,
     .name = "dirty",
     .does = "No echo comes through that share of its window, in patches that stay where they are; "
             "its state reports that share",
     .low = 0,
     .high = 1,
     .otherwise = 0.3,
     .act = [](F f, E e) { e->lidar.dirt = 1 - (1 - e->lidar.dirt) * (1 - f.by * f.grown); }},
    {.of = Component::kLidar,
     .name = "noisy",
     .does = "Its ranges are spread with that standard deviation, besides their own",
     .unit = "m",
     .low = 0,
     .high = 1,
     .otherwise = 0.05,
     .act = [](F f, E e) { e->lidar.noise = std::hypot(e->lidar.noise, f.by * f.grown); }},
    {.of = Component::kCamera,
     .name = "frozen",
     .does = "It gives its last picture again and again",
     .act = [](F f, E e) { e->cameras[f.element].frozen = true; }},
    {.of = Component::kCamera,
     .name = "lossy",
     .does = "That share of its pictures does not come: the call gets no answer",
     .low = 0,
     .high = 1,
     .otherwise = 0.1,
     .act = [](F f, E e) { e->cameras[f.element].lost |= f.chance < f.by * f.grown; }},
    {.of = Component::kCamera,
     .name = "dark",
     .does = "That share of the light does not reach it",
     .low = 0,
     .high = 1,
     .otherwise = 0.9,
     .act = [](F f, E e) { e->cameras[f.element].light *= 1 - f.by * f.grown; }},
    {.of = Component::kCamera,
     .name = "noisy",
     .does = "Each colour of each pixel is spread with that standard deviation, of 255 levels",
     .unit = "levels",
     .low = 0,
     .high = 128,
     .otherwise = 20,
     .act =
         [](F f, E e) {
           double& noise = e->cameras[f.element].noise;
           noise = std::hypot(noise, f.by * f.grown);
         }},
    {.of = Component::kHand,
     .name = "off",
     .does = "It has died: no state is sent, no command read. The hand does what it does when "
             "commands stop; once it runs again it starts as with the robot",
     .act =
         [](F f, E e) {
           e->hands[f.element].dead = true;
           for (const std::size_t link : f.links) e->links[link].drops = true;
         }},
});

struct ComponentNames {
  std::string_view name, named_as;
  std::string_view form;  // of its name in requests, with NAME for a part of it
};

// In the order of the enum.
constexpr auto kComponentNames = std::to_array<ComponentNames>({
    {"motor", "its joint: `FR_calf_joint`", "a joint"},
    {"encoder", "its joint's: `FR_calf_joint.encoder`", "JOINT.encoder"},
    {"inertial unit", "`imu`, `secondary_imu`", "imu"},
    {"foot's sensor", "its foot's: `foot.FR`", "foot.NAME"},
    {"battery", "`battery`", "battery"},
    {"remote controller", "`remote`", "remote"},
    {"topic", "itself: `rt/lowstate`", "a topic"},
    {"service", "its name: `service.sport`", "service.NAME"},
    {"bus", "itself: `bus.FR`, a hand's `bus.left_hand`", "bus.NAME"},
    {"fan", "itself: `fan.front`", "fan.NAME"},
    {"mainboard", "`mainboard`", "mainboard"},
    {"small controller of the mainboard", "`mcu`", "mcu"},
    {"lidar", "`lidar`", "lidar"},
    {"camera", "itself: `camera.front`", "camera.NAME"},
    {"hand's program", "its hand's: `hand.left`, `hand.inspire`", "hand.NAME"},
});
static_assert(kComponentNames.size() == kComponents);

}  // namespace

std::span<const FaultKind> FaultKinds() { return kKinds; }

std::span<const std::string_view> FaultNames() {
  static const std::vector<std::string_view> kNames = [] {
    std::vector<std::string_view> names{kNoFault};
    for (const FaultKind& kind : kKinds) {
      if (std::ranges::find(names, kind.name) == names.end()) names.push_back(kind.name);
    }
    return names;
  }();
  return kNames;
}

std::string_view NameOf(Component component) {
  return kComponentNames[static_cast<std::size_t>(component)].name;
}

std::string_view NamedAs(Component component) {
  return kComponentNames[static_cast<std::size_t>(component)].named_as;
}

std::string ComponentForms() {
  std::string forms;
  for (std::size_t i = 0; i < kComponents; ++i) {
    if (i > 0) forms += i + 1 < kComponents ? ", " : " or ";
    forms += kComponentNames[i].form;
  }
  return forms;
}

}  // namespace understudy::robot
