// What can be wrong with the parts of a robot: a table of kinds, and what they do to the models.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "robot/robot_spec.h"

namespace understudy::robot {

// The parts that can have faults.
enum class Component : std::uint8_t {
  kMotor,
  kEncoder,
  kImu,
  kFoot,
  kBattery,
  kRemote,
  kTopic,
  kService,
  kBus,
  kFan,
  kMainboard,
  kMcu,
  kLidar,
  kCamera,
  kHand,
};

inline constexpr std::size_t kComponents = 15;

// What is wrong with each part now, as its model reads it. Default values: nothing.

struct MotorEffects {
  double torque_share = 1;  // of the torque that it would give
  double drag = 0;          // N·m, friction against its rate
  double heat_c = 0;        // °C that it is hotter by
  bool jammed = false;      // its joint does not turn
  bool silent = false;      // it does not answer: its readings stay as they were
  bool unheard = false;     // its answer of this tick is lost
};

struct EncoderEffects {
  bool dead = false;     // reads 0
  bool stuck = false;    // reads what it read
  bool garbage = false;  // reads anything within a turn either way
  double offset = 0;     // rad
  double noise = 0;      // rad, standard deviation

  bool tells() const { return dead || garbage; }  // the motor's board knows of it; *assumed*
};

struct ImuEffects {
  bool dead = false;   // reads 0, and no turn
  bool stuck = false;  // reads what it read
  double rate = 0;     // rad/s, offset of the rate about each axis
  double tilt = 0;     // rad that it is mounted turned by about its y
  double turn = 0;     // rad that its heading is off by
  double noise = 0;    // rad/s, standard deviation of the rates

  bool fine() const { return !dead && !stuck && rate == 0 && tilt == 0 && turn == 0 && noise == 0; }
};

struct FootEffects {
  bool stuck = false;  // reads what it read
  double share = 1;    // of the force
  double offset = 0;   // N
};

struct BatteryEffects {
  double resistance = 1;   // as many times its internal resistance
  double most_charge = 1;  // of 0 to 1
};

struct LinkEffects {
  bool drops = false;     // nothing goes through in this tick
  bool doubles = false;   // all of it twice
  bool damages = false;   // with a wrong crc, or not at all where there is none
  bool reorders = false;  // it goes after what comes next
  double delay = 0;       // s that it comes later, never before what was sent before it
};

struct ServiceEffects {
  bool off = false;     // it neither acts nor answers
  bool absent = false;  // its program does not run yet: nobody reads its requests
  double delay = 0;     // s of wall time that its answers are late by
};

struct BusEffects {
  bool drops = false;  // no command goes through in this tick
  double delay = 0;    // s that a command comes later
};

struct FanEffects {
  double share = 1;  // of its speed
};

struct BoardEffects {
  bool dead = false;  // nothing computes
  bool mute = false;  // its small controller does not answer: what it tells stays as it was
  double heat_c = 0;  // °C that it is hotter by
};

struct LidarEffects {
  bool dead = false;   // says nothing
  bool blind = false;  // no echo comes back
  double lost = 0;     // share of echoes
  double dirt = 0;     // share of its window through which no echo comes back
  double noise = 0;    // m, standard deviation of a range
};

struct CameraEffects {
  bool frozen = false;  // its picture stays as it was
  bool lost = false;    // a picture that is asked for now does not come
  double light = 1;     // share of the light that reaches it
  double noise = 0;     // of 255 levels, standard deviation of each colour of a pixel
};

struct HandEffects {
  bool dead = false;  // the program that drives it does not run
};

struct Effects {
  std::vector<MotorEffects> motors{};  // motor order, as the next
  std::vector<EncoderEffects> encoders{};
  std::array<ImuEffects, 2> imus{};  // of LowState, and the second
  std::vector<FootEffects> feet{};   // in RobotSpec::feet order
  BatteryEffects battery{};
  bool remote_off = false;
  std::vector<LinkEffects> links{};  // of commands, then of all that the robot publishes
  std::vector<ServiceEffects> services{};
  std::vector<BusEffects> buses{};  // of BusesOf
  std::vector<FanEffects> fans{};   // in RobotSpec::fans order
  BoardEffects board{};
  LidarEffects lidar{};
  std::vector<CameraEffects> cameras{};  // in RobotSpec::cameras order
  std::vector<HandEffects> hands{};      // in RobotSpec::hands order
};

// A fault as it acts in a tick.
struct ActingFault {
  std::size_t element = 0;                // which of the components of its kind
  double by = 0;                          // of the kind's unit
  double grown = 1;                       // 0 to 1: how far its ramp has come
  double age = 0;                         // s
  double chance = 0;                      // drawn for this fault and tick from [0, 1)
  std::span<const std::size_t> motors{};  // of a bus, in motor order
  std::span<const std::size_t> links{};   // of a hand's program: its topics, in Effects::links
};

// A kind of fault of a component. A new one is a row, and an effect where there is none for it.
struct FaultKind {
  Component of;
  std::string_view name;
  std::string_view does;
  // Its magnitude `by`: unit, limits, and what it is unless given. Both limits 0: it has none.
  std::string_view unit{};
  double low = 0, high = 0, otherwise = 0;
  void (*act)(const ActingFault& fault, Effects* effects) = nullptr;
  // Whether such a component of the robot can have it; null: of every robot.
  bool (*fits)(const RobotSpec& spec) = nullptr;

  bool has_magnitude() const { return low != high; }
};

// Returns all kinds, in the order of the documentation. Magnitudes unless given are *assumed*.
std::span<const FaultKind> FaultKinds();

// In place of a kind in requests: takes faults away.
inline constexpr std::string_view kNoFault = "none";
// Returns kNoFault and the names of all kinds, each once.
std::span<const std::string_view> FaultNames();

// Returns what the documentation calls such components: "motor".
std::string_view NameOf(Component component);
// Returns how one of them is named in requests: "FR_calf_joint.encoder" for "FR_calf_joint".
std::string_view NamedAs(Component component);
// Returns how components are named in requests: "a joint, JOINT.encoder, imu, ... or hand.NAME".
std::string ComponentForms();

}  // namespace understudy::robot
