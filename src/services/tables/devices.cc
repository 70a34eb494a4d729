// The services of devices: voice, lights, cameras, obstacle avoidance, UWB.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "services/tables/fields.h"
#include "services/tables/tables.h"

namespace understudy::services {
namespace {

using namespace fields;  // NOLINT(google-build-using-namespace): the words a table is made of
using nlohmann::json;

constexpr std::int32_t kDeviceError = 100;  // the only code of vui, voice and the videohubs

// No speaker is modelled: the text goes to the log, quoted and escaped.
ServiceReply Speak(const ServiceCall& call) {
  *call.notice = "voice says " + call.parameter.at("text").dump(-1, ' ', true);
  return {};
}

ServiceReply PlayChunk(const ServiceCall& call) {
  *call.notice = "voice plays " + std::to_string(call.binary_bytes) + " bytes of " +
                 call.parameter.at("stream_id").dump(-1, ' ', true);
  return {};
}

ServiceReply StopPlaying(const ServiceCall&) { return {}; }

ServiceReply SwitchAvoidance(const ServiceCall& call) {
  const bool on = call.parameter.at("enable").get<bool>();
  (*call.settings)["enable"] = on;
  call.owner->onboard().avoids = on;
  return {};
}

// Modes of obstacles_avoid's Move: 0 velocity, 1 displacement from here, 2 position in the world.
ServiceReply AvoidingMove(const ServiceCall& call) {
  // [docs]: nothing moves before UseRemoteCommandFromApi(true).
  if (call.settings->at("remote_from_api") != true) return {.refusal = CallRefusal::kState};
  namespace goal = authority::goal;
  const auto within = [&](const char* key, double bound) {
    return std::clamp(call.parameter.at(key).get<double>(), -bound, bound);
  };
  const int mode = call.parameter.at("mode").get<int>();
  const bool avoids = call.owner->avoids();
  authority::MotionGoal wish = goal::Move{.vx = within("x", 1.5),
                                          .vy = within("y", 1.0),
                                          .yaw_rate = within("yaw", 1.57),
                                          .hold = 1,
                                          .avoids = avoids};
  if (mode != 0) {
    const double most = mode == 1 ? 2 : kInf;
    wish = goal::GoTo{.x = within("x", most),
                      .y = within("y", most),
                      .yaw = within("yaw", mode == 1 ? 1.57 : kInf),
                      .from_here = mode == 1,
                      .avoids = avoids};
  }
  const authority::MotionVerdict verdict = call.owner->Ask(wish);
  const bool done =
      verdict == authority::MotionVerdict::kTaken || verdict == authority::MotionVerdict::kIgnored;
  return {.code = done ? kRpcOk : kRpcServerInternal};
}

}  // namespace

ServiceTable ObstaclesAvoidTable() {
  constexpr std::string_view kSdk = "[sdk] go2/obstacles_avoid";
  return {
      .name = "obstacles_avoid",
      .title = "obstacles_avoid",
      .api_version = "1.0.0.2",
      .program = "obstacles_avoidance",
      .rows =
          {
              Row(1001, "SwitchSet", {Bool("enable")}, Special{&SwitchAvoidance},
                  "whether Move and the remote's sticks avoid obstacles", kSdk),
              Row(1002, "SwitchGet", {}, GiveSetting{"enable", "enable"},
                  "what was set; false at the start",
                  "[sdk] go2/obstacles_avoid; [seen] on a Go2 after boot"),
              Row(1003, "Move", {Number("x"), Number("y"), Number("yaw"), Int("mode", 0, 2)},
                  Special{&AvoidingMove},
                  "mode 0: velocity for 1 s, within 1.5, 1 m/s, 1.57 rad/s; 1: to a position from "
                  "here, within 2 m, 1.57 rad; 2: to a position of rt/sportmodestate; without the "
                  "switch through obstacles",
                  "[sdk] go2/obstacles_avoid; [docs] ranges; that more is clamped, that it walks "
                  "without the switch, and which world mode 2 means, is assumed"),
              Row(1004, "UseRemoteCommandFromApi", {Bool("is_remote_commands_from_api")},
                  KeepSetting{"remote_from_api"}, "stored; Move is ignored without it",
                  "[sdk] go2/obstacles_avoid; [docs]"),
          },
      .settings = {{"enable", "false"}, {"remote_from_api", "false"}},
      .note = "What it sees and avoids: [seeing.md](../seeing.md#obstacles)."};
}

ServiceTable VuiTable() {
  constexpr std::string_view kSdk = "[sdk] go2/vui; [docs] ranges, 100";
  return {
      .name = "vui",
      .title = "vui",
      .api_version = "1.0.0.1",
      .parameter_code = kDeviceError,
      .program = "vui_service",
      .rows =
          {
              Row(1001, "SetSwitch", {Int("enable", 0, 1)}, KeepSetting{"enable"}, "kept", kSdk),
              Row(1002, "GetSwitch", {}, GiveSetting{"enable", "enable"}, "what was set", kSdk),
              Row(1003, "SetVolume", {Int("volume", 0, 10)}, KeepSetting{"volume"}, "kept", kSdk),
              Row(1004, "GetVolume", {}, GiveSetting{"volume", "volume"}, "what was set", kSdk),
              Row(1005, "SetBrightness", {Int("brightness", 0, 10)}, KeepSetting{"brightness"},
                  "kept", kSdk),
              Row(1006, "GetBrightness", {}, GiveSetting{"brightness", "brightness"},
                  "what was set", kSdk),
          },
      // Assumed: no start values are published.
      .settings = {{"enable", "1"}, {"volume", "5"}, {"brightness", "5"}},
      .note = "Code 100 for a bad parameter. The start values (1, 5, 5) are assumed."};
}

ServiceTable VoiceTable() {
  constexpr std::string_view kSdk = "[sdk] g1/audio; [docs] G1 VuiClient";
  return {
      .name = "voice",
      .title = "voice",
      .api_version = "1.0.0.0",
      .parameter_code = kDeviceError,
      .codes = {.unable = kDeviceError},
      .program = "vui_service",
      .rows =
          {
              Row(1001, "TtsMaker", {Int("index"), Int("speaker_id"), Text("text")},
                  Special{&Speak}, "writes the text to the log; no sound", kSdk),
              Row(1002, "Asr", {}, NoController{}, "no microphone is modelled", "[sdk] g1/audio"),
              {.id = 1003,
               .name = "PlayStream",
               .fields = {Text("app_name"), Text("stream_id")},
               .effect = Special{&PlayChunk},
               .does = "takes up to 96000 bytes of sound and logs their number; no sound",
               .source = "[sdk] g1/audio; its example sends 96000 bytes at once",
               .takes_binary = true},
              Row(1004, "PlayStop", {Text("app_name")}, Special{&StopPlaying}, "stops playing",
                  kSdk),
              Row(1005, "GetVolume", {}, GiveSetting{"volume", "volume"}, "what was set", kSdk),
              Row(1006, "SetVolume", {Int("volume", 0, 100)}, KeepSetting{"volume"}, "kept", kSdk),
              Row(1010, "LedControl", {Int("R", 0, 255), Int("G", 0, 255), Int("B", 0, 255)},
                  KeepSetting{"led"}, "kept", kSdk),
          },
      .settings = {{"volume", "50"}},  // assumed
      .note = "Code 100 for a bad parameter. The start volume, 50, is assumed."};
}

ServiceTable UwbSwitchTable() {
  constexpr std::string_view kSdk = "[sdk] go2/utrack";
  return {
      .name = "uwbswitch",
      .title = "uwbswitch",
      .api_version = "1.0.0.1",
      .program = "utrack",
      .has_switch_topics = true,
      .rows =
          {
              Row(1001, "SwitchSet", {Int("enable", 0, 1)}, KeepSetting{"enable"}, "kept", kSdk),
              Row(1002, "SwitchGet", {}, GiveSetting{"enable", "enable"},
                  "what was set; 0 at the start (assumed)", kSdk),
              Row(1003, "IsTracking", {}, GiveSetting{"tracking", "enable"},
                  "0: there is no beacon to track", kSdk),
          },
      .settings = {{"enable", "0"}, {"tracking", "0"}}};
}

ServiceTable VideoTable(std::string_view name, std::string_view version) {
  return {.name = name,
          .title = name,
          .api_version = version,
          .parameter_code = kDeviceError,
          .codes = {.unable = kDeviceError},
          .program = "video_hub",
          .rows = {Row(1001, "GetImageSample", {}, GivePicture{},
                       "a JPEG of what the camera sees, in binary; 100 where there is none",
                       "[sdk] video")},
          .note = "What a robot's cameras are: [seeing.md](../seeing.md#cameras)."};
}

}  // namespace understudy::services
