// What a service offers, as data: one row per api decodes, checks, acts, documents and is tested.
#pragma once

#include <chrono>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "authority/motor_owner.h"

namespace understudy::services {

// Codes of the vendor's RPC layer (docs/sources.md#requests).
inline constexpr std::int32_t kRpcOk = 0;
inline constexpr std::int32_t kRpcServerInternal = 3202;
inline constexpr std::int32_t kRpcApiNotImplemented = 3203;
inline constexpr std::int32_t kRpcApiParameter = 3204;
inline constexpr std::int32_t kRpcLeaseDenied = 3205;
inline constexpr std::int32_t kRpcLeaseNotExist = 3206;
inline constexpr std::int32_t kRpcLeaseExist = 3207;

enum class FieldKind : std::uint8_t {
  kBool,     // true or false
  kFlag,     // true, false, 0 or 1: the vendor's clients disagree
  kInt,      // a whole number, 3 or 3.0
  kNumber,   // finite
  kNumbers,  // array of `count` finite numbers; any length when count is 0
  kText,
  kPath,  // array of `count` objects of numbers, each with at least t_from_start, x, y and yaw
};

enum class OutOfRange : std::uint8_t { kRefuse, kClamp };

// One member of the parameter object.
struct Field {
  std::string_view key;  // "" where the parameter is the value itself
  FieldKind kind = FieldKind::kNumber;
  double low = -std::numeric_limits<double>::infinity();  // of each number, inclusive
  double high = std::numeric_limits<double>::infinity();
  OutOfRange beyond = OutOfRange::kRefuse;
  int count = 0;               // elements of kNumbers and kPath; 0 = any
  bool optional = false;       // may be missing
  std::string_view also = {};  // another key under which some clients send it
};

using Settings = std::map<std::string, nlohmann::json, std::less<>>;

// A text of config that was set or, without content, forgotten.
struct ConfigChange {
  std::string name;
  std::string content{};
};

struct ServiceReply {
  std::int32_t code = kRpcOk;
  std::string data{};  // JSON, or "" where the vendor's clients ignore it
  // Sent once this holds of the motion service, or after `patience`; null: at once.
  bool (*once)(const robot::MotionState& state) = nullptr;
  // How long it waits for that and for the asking client's reader; the default is assumed.
  std::chrono::nanoseconds patience = std::chrono::milliseconds(300);
  std::optional<ConfigChange> change{};  // to be told on rt/config_change_status
};

// What a special function gets of one call. `parameter` is decoded and within its row's schema.
struct ServiceCall {
  const nlohmann::json& parameter;
  std::size_t binary_bytes;
  authority::MotorOwner* owner;
  Settings* settings;
  std::string* notice;  // what the log should say; "" = nothing
};

// Kinds of effects. None claims a success that did not happen.
struct AskGoal {
  // Makes the goal of all numbers of the parameter in the schema's order and then of these.
  authority::GoalMaker goal;
  std::vector<double> then{};
  // Setting in which the parameter's first field is kept when the goal is taken; "" = none.
  std::string_view keep{};
  std::optional<std::int32_t> not_now{};  // instead of the service's own code
  std::optional<std::int32_t> unknown{};
};
struct KeepSetting {  // field by field: under `name`, and "name.key" for further fields
  std::string_view name;
};
struct GiveSetting {
  std::string_view name;
  std::string_view key;  // of the reply's object
  // State-machine ids in which the robot sends the value with the code `refused` (seen on a G1).
  std::vector<int> refused_in{};
  std::int32_t refused = 0;
};
enum class StateWord : std::uint8_t { kId, kMode };
struct GiveState {
  StateWord word;
  std::string_view key;
};
struct NoController {};  // the robot could, nothing here can: a failure code and a line in the log
struct Special {
  ServiceReply (*answer)(const ServiceCall& call);
  bool only_reads = false;
};
using Effect = std::variant<AskGoal, KeepSetting, GiveSetting, GiveState, NoController, Special>;

struct ApiRow {
  std::int64_t id = 0;
  std::string_view name{};
  std::vector<Field> fields{};
  Effect effect{};
  std::string_view does{};
  std::string_view source{};
  std::optional<std::int32_t> parameter_code{};  // instead of the service's
  std::optional<std::int32_t> unable_code{};     // instead of the service's
  bool takes_binary = false;
};

// Which code stands for what became of a goal.
struct VerdictCodes {
  std::int32_t not_now = 0;
  std::int32_t unknown = 0;
  std::int32_t unable = 0;
};

// A service: its rows and what they share.
struct ServiceTable {
  std::string_view name{};         // "sport": rt/api/sport/request
  std::string_view title{};        // as the documentation calls this variant: "sport of Go2, Go2-W"
  std::string_view api_version{};  // what internal api 1 answers
  std::int32_t parameter_code = kRpcApiParameter;
  VerdictCodes codes{};
  // The program on board that serves it, by the names of robot_state: while that is listed and off,
  // nothing answers. "" = always served.
  std::string_view program{};
  bool needs_motion = false;       // served by the motion service or only while one is on
  bool tells_changes = false;      // on rt/config_change_status
  bool has_switch_topics = false;  // SwitchTopics throw what it sets
  std::vector<ApiRow> rows{};
  std::vector<std::pair<std::string_view, std::string_view>> settings{};  // name, JSON at the start
  std::string_view note{};
};

}  // namespace understudy::services
