// The services of every robot's computer: motion_switcher, robot_state and config.
#include <array>
#include <chrono>
#include <ctime>

#include <nlohmann/json.hpp>

#include "services/status_texts.h"
#include "services/tables/fields.h"
#include "services/tables/tables.h"

namespace understudy::services {
namespace {

using namespace fields;  // NOLINT(google-build-using-namespace): the words a table is made of
using nlohmann::json;

// --- motion_switcher ---

constexpr std::int32_t kOtherIsOn = 7002;
constexpr std::int32_t kBadName = 7004;
constexpr std::int32_t kSelectFailed = 7007;

ServiceReply CheckMode(const ServiceCall& call) {
  return {.data = json{{"form", call.owner->form()}, {"name", call.owner->active()}}.dump()};
}

ServiceReply SelectMode(const ServiceCall& call) {
  const auto& name = call.parameter.at("name").get_ref<const std::string&>();
  if (call.owner->active() == "mcf" && name != "mcf") {
    return {.code = kOtherIsOn, .refusal = CallRefusal::kState};
  }
  switch (call.owner->Select(name)) {
    case authority::OwnerVerdict::kDone:
      return {};
    case authority::OwnerVerdict::kUnknownName:
      return {.code = kBadName, .refusal = CallRefusal::kName};
    case authority::OwnerVerdict::kProtected:
    case authority::OwnerVerdict::kNoController:
      break;
  }
  return {.code = kSelectFailed, .refusal = CallRefusal::kNotSimulated};
}

ServiceReply ReleaseMode(const ServiceCall& call) {
  call.owner->Release();
  return {};
}

ServiceReply SetSilent(const ServiceCall& call) {
  call.owner->onboard().silent = call.parameter.at("silent").get<bool>();
  return {};
}

ServiceReply GetSilent(const ServiceCall& call) {
  return {.data = json{{"silent", call.owner->onboard().silent}}.dump()};
}

// --- robot_state ---

// Statuses on the wire, 0 for on: [docs] Go2 RobotStateClient, [seen] on a robot.
constexpr int kOn = 0;
constexpr int kOff = 1;
constexpr int kFailed = 2;     // assumed: clients call all but 0, 1 and 5 a failure, 5201
constexpr int kProtected = 5;  // [seen]: clients make 5202 of it
constexpr double kMostSeconds = 86'400;

ServiceReply ServiceSwitch(const ServiceCall& call) {
  const auto& name = call.parameter.at("name").get_ref<const std::string&>();
  const bool on = call.parameter.at("switch").get<int>() == 1;
  int status = on ? kOn : kOff;
  CallRefusal refusal = CallRefusal::kNone;
  switch (call.owner->Switch(name, on)) {
    case authority::OwnerVerdict::kDone:
      break;
    case authority::OwnerVerdict::kProtected:
      status = kProtected;
      refusal = CallRefusal::kProtected;
      break;
    case authority::OwnerVerdict::kNoController:
      status = kFailed;
      refusal = CallRefusal::kNotSimulated;
      break;
    case authority::OwnerVerdict::kUnknownName:
      status = kFailed;
      refusal = CallRefusal::kName;
      break;
  }
  return {.data = json{{"name", name}, {"status", status}}.dump(), .refusal = refusal};
}

ServiceReply SetReportFreq(const ServiceCall& call) {
  const auto seconds = [&](const char* key) { return call.parameter.at(key).get<int>(); };
  call.owner->onboard().RequestReport(seconds("interval"), seconds("duration"));
  return {};
}

ServiceReply ServiceList(const ServiceCall& call) {
  return {.data = ProgramList(call.owner->services())};
}

std::vector<ApiRow> RobotStateRows() {
  return {
      Row(1001, "ServiceSwitch", {Text("name"), Int("switch", 0, 1)}, Special{&ServiceSwitch},
          "1 switches on, 0 off; answers the status that follows: 0 on, 1 off, 5 protected "
          "(clients say 5202), 2 failed (clients say 5201)",
          "[sdk] robot_state; [docs] Go2 RobotStateClient; [seen] 5; that 2 means failure is "
          "assumed"),
      Row(1002, "SetReportFreq",
          {Int("interval", 0, kMostSeconds), Int("duration", 0, kMostSeconds)},
          Special{&SetReportFreq},
          "writes ServiceList's array on rt/servicestate, at once and every `interval` s; 0 ends "
          "that; "
          "duration s, 0: for good (units and zeros assumed)",
          "[sdk] robot_state; [seen] every 5 s on a G1"),
      Row(1003, "ServiceList", {}, Special{&ServiceList, true},
          "an array of name, status (0 on, 1 off), protect and, where it is known, version",
          "[sdk] robot_state; [seen] bare array, versions on a G1"),
  };
}

ServiceReply GiveVersions(const ServiceCall&) {
  return {.data =
              json{{"packageVersion", "understudy"}, {"moduleVersionMap", json::object()}}.dump()};
}

// --- config ---

constexpr std::int32_t kNotFound = 8202;
constexpr std::int32_t kNameInvalid = 8203;
constexpr std::int32_t kLimited = 8204;
constexpr std::size_t kMostName = 64;      // assumed
constexpr std::size_t kMostConfigs = 256;  // assumed

std::int32_t NameCode(const std::string& name) {
  if (name.empty()) return kNameInvalid;
  return name.size() > kMostName ? kLimited : kRpcOk;
}

ServiceReply SetConfig(const ServiceCall& call) {
  const auto& name = call.parameter.at("name").get_ref<const std::string&>();
  if (const auto code = NameCode(name); code != kRpcOk) return {.code = code};
  if (!call.settings->contains(name) && call.settings->size() >= kMostConfigs) {
    return {.code = kLimited};
  }
  const auto now = std::chrono::system_clock::now();
  const auto seconds = std::chrono::system_clock::to_time_t(now);
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  std::array<char, 32> date{};
  std::strftime(date.data(), date.size(), "%Y-%m-%d %H:%M:%S", &parts);
  const json& content = call.parameter.at("content");
  (*call.settings)[name] = {{"content", content},
                            {"name", name},
                            {"lastModified", date.data()},
                            {"size", content.get_ref<const std::string&>().size()},
                            {"epoch", seconds}};
  return {.change = ConfigChange{.name = name, .content = content.get<std::string>()}};
}

// Returns the stored entry of that name, or null and sets the code of `reply`.
const json* FindConfig(const ServiceCall& call, ServiceReply* reply) {
  const auto& name = call.parameter.at("name").get_ref<const std::string&>();
  reply->code = NameCode(name);
  if (reply->code != kRpcOk) return nullptr;
  const auto found = call.settings->find(name);
  if (found != call.settings->end()) return &found->second;
  reply->code = kNotFound;
  return nullptr;
}

ServiceReply GetConfig(const ServiceCall& call) {
  ServiceReply reply;
  if (const json* entry = FindConfig(call, &reply)) {
    reply.data = json{{"content", entry->at("content")}}.dump();
  }
  return reply;
}

ServiceReply DeleteConfig(const ServiceCall& call) {
  ServiceReply reply;
  if (const json* entry = FindConfig(call, &reply)) {
    const auto name = entry->at("name").get<std::string>();
    call.settings->erase(call.settings->find(name));
    reply.change = ConfigChange{.name = name};
  }
  return reply;
}

ServiceReply GetMeta(const ServiceCall& call) {
  ServiceReply reply;
  if (const json* entry = FindConfig(call, &reply)) {
    json meta = *entry;
    meta.erase("content");
    reply.data = json{{"meta", meta}}.dump();
  }
  return reply;
}

}  // namespace

ServiceTable MotionSwitcherTable() {
  constexpr std::string_view kSdk = "[sdk] motion_switcher";
  return {.name = "motion_switcher",
          .title = "motion_switcher",
          .api_version = "1.0.0.1",
          .parameter_code = 7001,
          .rows =
              {
                  Row(1001, "CheckMode", {}, Special{&CheckMode, true},
                      "form and name of the motion service that is on; \"\" if rt/lowcmd moves the "
                      "motors",
                      "[sdk] motion_switcher; [docs] Go2, G1"),
                  Row(1002, "SelectMode", {Text("name")}, Special{&SelectMode},
                      "starts a motion service; 7002 while mcf is on and another is asked for, "
                      "7004 unknown "
                      "name, 7007 not simulated",
                      "[sdk] motion_switcher; [seen] 7004 on a G1, 7002 and 7004 on a Go2"),
                  Row(1003, "ReleaseMode", {}, Special{&ReleaseMode},
                      "stops the motion service; the motors follow rt/lowcmd", kSdk),
                  Row(1004, "SetSilent", {Bool("silent")}, Special{&SetSilent},
                      "stored for the run: start no motion service at boot", kSdk),
                  Row(1005, "GetSilent", {}, Special{&GetSilent, true}, "what was set", kSdk),
              },
          .note = "Code 7001 for a bad parameter."};
}

ServiceTable RobotStateTable() {
  return {.name = "robot_state",
          .title = "robot_state of Go2",
          .api_version = "1.0.0.1",
          .rows = RobotStateRows()};
}

ServiceTable RobotStateLongTable() {
  constexpr std::string_view kSdk = "[sdk] b2/robot_state";
  ServiceTable table{.name = "robot_state",
                     .title = "robot_state",
                     .api_version = "1.0.0.2",
                     .rows = RobotStateRows(),
                     .settings = {{"low_power", "1"}},
                     .note =
                         "G1's documentation says that it is the B2's; for the others that is "
                         "assumed."};
  table.rows.push_back({.id = 1004,
                        .name = "LowPowerSwitch",
                        .fields = {Int("switch", 0, 1)},
                        .effect = NoController{},
                        .does = "not simulated",
                        .source = "[sdk] b2/robot_state: 5203",
                        .unable_code = 5203});
  table.rows.push_back(Row(1005, "LowPowerStatus", {}, GiveSetting{"low_power", "status"},
                           "1, off (coded as a service's status, assumed)", kSdk));
  table.rows.push_back(Row(1006, "GetPkgVersion", {}, Special{&GiveVersions, true},
                           "packageVersion understudy, no modules", kSdk));
  return table;
}

ServiceTable ConfigTable() {
  constexpr std::string_view kSdk = "[sdk] config";
  return {.name = "config",
          .title = "config",
          .api_version = "1.0.0.1",
          .parameter_code = 8201,
          .rows =
              {
                  Row(1001, "Set", {Text("name"), Text("content")}, Special{&SetConfig},
                      "stores a text for the run; 8203 empty name, 8204 name over 64 bytes or more "
                      "than 256 texts (assumed)",
                      kSdk),
                  Row(1002, "Get", {Text("name")}, Special{&GetConfig, true},
                      "the content; 8202 if there is none", kSdk),
                  Row(1003, "Del", {Text("name")}, Special{&DeleteConfig}, "deletes it", kSdk),
                  Row(1004, "Meta", {Text("name")}, Special{&GetMeta, true},
                      "name, lastModified, size, epoch (assumed: seconds since 1970)", kSdk),
              },
          .note =
              "rt/config_change_status publishes each text that is set, and a deleted one with "
              "empty content. The topic was seen on a G1; its content, and that other robots have "
              "it, is assumed."};
}

}  // namespace understudy::services
