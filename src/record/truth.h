// What only the simulation knows, and what happened, as messages.
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

// The world between two steps: all of it at `time`, but for tau, foot_force and crane_tension,
// which acted in the step that led here.
struct Truth {
  std::int64_t step = 0;
  double time = 0;                   // simulated s
  std::vector<double> qpos{};        // as in mjData of the model that lies beside
  std::vector<double> qvel{};        // likewise
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
  std::string kind{};    // one word, see docs/recording.md
  std::string text{};    // for people
  std::string detail{};  // for programs: a JSON object
};

// As little-endian XCDR1 with its four bytes in front. Encoding overwrites `out`; decoding throws
// RecordError for what is no such message.
void EncodeTruth(const Truth& truth, BytesOut* out);
Truth DecodeTruth(ByteSpan bytes);
void EncodeEvent(const Event& event, BytesOut* out);
Event DecodeEvent(ByteSpan bytes);

}  // namespace understudy::record
