// The messages for the simulation's truth, for events and for the damage sheet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "record/bytes.h"
#include "robot/damage.h"

namespace understudy::record {

inline constexpr char kTruthTopic[] = "understudy/truth";
inline constexpr char kTruthType[] = "understudy_msgs/msg/Truth";
inline constexpr char kTruthText[] =
    "int64 step\n"
    "float64 time\n"
    "float64[] qpos\n"
    "float64[] qvel\n"
    "float64[] tau\n"
    "float64[] foot_force\n"
    "float64 crane_tension\n"
    "float64 nearest_obstacle\n"
    "float64[] hand_force\n"
    "float64[] touch\n";

// The true state between two steps, at `time`. tau, forces and crane_tension acted during the step
// before.
struct Truth {
  std::int64_t step = 0;
  double time = 0;                   // simulated s
  std::vector<double> qpos{};        // mjData::qpos of the attached model
  std::vector<double> qvel{};        // mjData::qvel
  std::vector<double> tau{};         // N·m at the joints, in motor order
  std::vector<double> foot_force{};  // N, in the order of robot.feet
  double crane_tension = 0;          // N
  // m, of perception::NearestObstacle; NaN where nobody asked for it, and in older recordings.
  double nearest_obstacle = std::numeric_limits<double>::quiet_NaN();
  // N, in the order of robot::HandNames; empty in older recordings.
  std::vector<double> hand_force{};
  // N, in the order of robot::PadNames; empty in older recordings.
  std::vector<double> touch{};
};

// Where in qpos and qvel a free joint begins: that of the robot's base, or of an object.
struct BaseAddress {
  std::size_t qpos = 0, qvel = 0;

  // In the metadata of the channel, which has none of a base that comes first.
  StringMap metadata() const;
  static BaseAddress Of(const StringMap& metadata);
};

// Those of the objects of the scene, by name.
using ObjectAddresses = std::map<std::string, BaseAddress, std::less<>>;
// Adds them to the metadata of the channel.
void AddObjects(const ObjectAddresses& objects, StringMap* metadata);
// Returns the one of that name; nullopt if there is none.
std::optional<BaseAddress> FindObject(std::string_view name, const StringMap& metadata);

// Whether the base of the robot is free. A model without any free joint has as many of qpos as of
// qvel.
bool HasFreeBase(const Truth& truth, const BaseAddress& base = {});

inline constexpr char kEventTopic[] = "understudy/events";
inline constexpr char kEventType[] = "understudy_msgs/msg/Event";
inline constexpr char kEventText[] =
    "int64 step\n"
    "float64 time\n"
    "string kind\n"
    "string text\n"
    "string detail\n";

struct RecordedEvent {
  std::int64_t step = 0;
  double time = 0;       // simulated s
  std::string kind{};    // one word (docs/recording.md)
  std::string text{};    // a line for people
  std::string detail{};  // a JSON object for programs
};

// Whether plots and films show events of this kind: not lateness, which is a matter of the machine,
// nor the many states of motions and the gate.
bool IsForPictures(std::string_view kind);

inline constexpr char kDamageTopic[] = "understudy/damage";
inline constexpr char kDamageType[] = "understudy_msgs/msg/Damage";
inline constexpr char kDamageText[] =
    "int64 step\n"
    "float64 time\n"
    "float64 energy\n"
    "float64 peak_current\n"
    "float64 shock\n"
    "float64 worst_tilt\n"
    "int64 falls\n"
    "float64 trip_c\n"
    "string[] joints\n"
    "float64[] torque_limit\n"
    "float64[] at_torque_limit\n"
    "float64[] speed_limit\n"
    "float64[] at_speed_limit\n"
    "float64[] hottest_c\n"
    "float64[] tripped\n"
    "float64[] hardest_stop\n"
    "float64[] largest_jump\n"
    "float64[] jump_limit\n"
    "string[] figures\n"
    "float64[] limits\n"
    "string[] units\n"
    "string[] sources\n";

// What the run would have done to the robot, from its start to `time`, with the limits by which it
// is measured. Vectors are in motor order.
struct Damage {
  std::int64_t step = 0;
  robot::DamageTotals sheet{};         // its time is the message's
  double trip_c = 0;                   // °C
  std::vector<std::string> joints{};   // never change, nor do the limits
  std::vector<double> torque_limit{};  // N·m
  std::vector<double> speed_limit{};   // rad/s; 0 = not known
  std::vector<double> jump_limit{};    // rad; 0 = not known
  std::vector<robot::DamageLimit> limits{};
};

// Encode to and decode from little-endian XCDR1 with the four bytes of the encoding. Encoding
// overwrites `out`; decoding throws RecordError for anything else.
void EncodeTruth(const Truth& truth, BytesOut* out);
Truth DecodeTruth(ByteSpan bytes);
void EncodeEvent(const RecordedEvent& event, BytesOut* out);
RecordedEvent DecodeEvent(ByteSpan bytes);
// The vectors must be as long as sheet.motors; decoding throws if they are not.
void EncodeDamage(const Damage& damage, BytesOut* out);
Damage DecodeDamage(ByteSpan bytes);

}  // namespace understudy::record
