// Describes a service as data. One row per api: its id, parameter, effect, documentation and
// source.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "authority/motor_owner.h"
#include "schema/field.h"
#include "services/call_refusal.h"

namespace understudy::services {

// Codes of the vendor's RPC layer (docs/dev/sources.md#requests).
inline constexpr std::int32_t kRpcOk = 0;
inline constexpr std::int32_t kRpcServerInternal = 3202;
inline constexpr std::int32_t kRpcApiNotImplemented = 3203;
inline constexpr std::int32_t kRpcApiParameter = 3204;
inline constexpr std::int32_t kRpcLeaseDenied = 3205;
inline constexpr std::int32_t kRpcLeaseNotExist = 3206;
inline constexpr std::int32_t kRpcLeaseExist = 3207;

using schema::Field;

using Settings = std::map<std::string, nlohmann::json, std::less<>>;

// A text of the config service that was set, or deleted if `content` is empty.
struct ConfigChange {
  std::string name;
  std::string content{};
};

struct ServiceReply {
  std::int32_t code = kRpcOk;
  std::string data{};  // JSON, or "" if the vendor's clients ignore it
  // The reply is sent when this condition holds or after `patience`; null: at once.
  bool (*once)(const robot::MotionState& state) = nullptr;
  // Longest wait for that condition and for the client's reader; the default is assumed.
  std::chrono::nanoseconds patience = std::chrono::milliseconds(300);
  // It is the answer if no picture of the service's camera comes; else that is, with kRpcOk.
  bool picture = false;
  std::optional<ConfigChange> change{};  // to be published on rt/config_change_status
  // Why it has no effect. kNone: the Service finds out by what the motion service said, and by
  // the code.
  CallRefusal refusal = CallRefusal::kNone;
};

// The arguments of a Special function. `parameter` is decoded and valid for the row's fields.
struct ServiceCall {
  const nlohmann::json& parameter;
  std::size_t binary_bytes;
  authority::MotorOwner* owner;
  Settings* settings;
  std::string* notice;  // a line for the log; "" = none
};

// The effects of an api. None replies with success for something that was not done.
struct AskGoal {
  // Makes the goal of the parameter's numbers, in the order of the fields, followed by `then`.
  authority::GoalMaker goal;
  std::vector<double> then{};
  // The setting that stores the parameter's first field if the goal is taken; "" = none.
  std::string_view keep{};
  std::optional<std::int32_t> not_now{};  // instead of the service's code
  std::optional<std::int32_t> unknown{};
};
struct KeepSetting {  // stores the first field under `name`, the others under "name.key"
  std::string_view name;
};
struct GiveSetting {
  std::string_view name;
  std::string_view key;  // in the reply's object
  // State-machine ids in which the value is sent with the code `refused` (seen on a G1).
  std::vector<int> refused_in{};
  std::int32_t refused = 0;
};
enum class StateWord : std::uint8_t { kId, kMode };
struct GiveState {
  StateWord word;
  std::string_view key;
};
struct GivePicture {};   // of the service's camera; replies with a failure code if none comes
struct NoController {};  // not simulated: replies with a failure code
struct Special {
  ServiceReply (*answer)(const ServiceCall& call);
  bool only_reads = false;
};
using Effect =
    std::variant<AskGoal, KeepSetting, GiveSetting, GiveState, GivePicture, NoController, Special>;

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

// The codes that answer the verdicts on a goal.
struct VerdictCodes {
  std::int32_t not_now = 0;
  std::int32_t unknown = 0;
  std::int32_t unable = 0;
};

// A service: its rows and what they have in common.
struct ServiceTable {
  std::string_view name{};         // "sport": rt/api/sport/request
  std::string_view title{};        // heading in the documentation: "sport of Go2"
  std::string_view api_version{};  // the answer to api 1
  std::int32_t parameter_code = kRpcApiParameter;
  VerdictCodes codes{};
  // The program on the robot that serves it, as robot_state names it. While that is listed and off,
  // nothing answers. "" = always served.
  std::string_view program{};
  bool needs_motion = false;       // served only while a motion service is on
  bool has_switch_topics = false;  // SwitchTopics can set its settings
  std::vector<ApiRow> rows{};
  std::vector<std::pair<std::string_view, std::string_view>> settings{};  // name, JSON at the start
  std::string_view note{};
};

}  // namespace understudy::services
