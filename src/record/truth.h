// The messages for the simulation's truth and for events.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "record/bytes.h"

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
    "float64 crane_tension\n";

// The true state between two steps, at `time`. tau, foot_force and crane_tension acted during the
// step before.
struct Truth {
  std::int64_t step = 0;
  double time = 0;                   // simulated s
  std::vector<double> qpos{};        // mjData::qpos of the attached model
  std::vector<double> qvel{};        // mjData::qvel
  std::vector<double> tau{};         // N·m at the joints, in motor order
  std::vector<double> foot_force{};  // N, in the order of robot.feet
  double crane_tension = 0;          // N
};

inline constexpr char kEventTopic[] = "understudy/events";
inline constexpr char kEventType[] = "understudy_msgs/msg/Event";
inline constexpr char kEventText[] =
    "int64 step\n"
    "float64 time\n"
    "string kind\n"
    "string text\n"
    "string detail\n";

struct Event {
  std::int64_t step = 0;
  double time = 0;       // simulated s
  std::string kind{};    // one word (docs/recording.md)
  std::string text{};    // a line for people
  std::string detail{};  // a JSON object for programs
};

// Encode to and decode from little-endian XCDR1 with the four bytes of the encoding. Encoding
// overwrites `out`; decoding throws RecordError for anything else.
void EncodeTruth(const Truth& truth, BytesOut* out);
Truth DecodeTruth(ByteSpan bytes);
void EncodeEvent(const Event& event, BytesOut* out);
Event DecodeEvent(ByteSpan bytes);

}  // namespace understudy::record
