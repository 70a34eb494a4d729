#include "services/status_texts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "base/nearest_word.h"

namespace understudy::services {
namespace {

using nlohmann::json;
using Services = std::span<const std::unique_ptr<Service>>;

// A setting of a service of the robot; null if it has none.
json SettingOf(Services services, std::string_view service, std::string_view setting) {
  for (const std::unique_ptr<Service>& one : services) {
    if (one->table().name != service) continue;
    const auto found = one->settings().find(setting);
    return found == one->settings().end() ? json() : found->second;
  }
  return {};
}

constexpr double kSlack = 1e-6;  // s: far below a step

// When it is due again that was due at `due` and is told at t, where some may have been left out.
double NextAfter(double t, double due, double period) {
  return due + period * std::max(1.0, std::ceil((t + kSlack - due) / period));
}

json OrElse(const json& value, const json& otherwise) {
  return value.is_null() ? otherwise : value;
}

}  // namespace

// Topics, rates and keys: seen on Go2 and G1 (docs/sources.md#notes-on-real-robots). The values of
// multiplestate are the services' settings, as its keys say; that those of the others stay as they
// were seen, without a network, satellites or sound, is assumed, and so is the rate of
// public_network_status.
struct StatusTexts::Row {
  std::string_view topic;
  double hz;
  Text text;
};

std::span<const StatusTexts::Row> StatusTexts::Rows() {
  static constexpr Row kRows[] = {
      {"rt/rtc/state", 1,
       [](Services) {
         return json{{"connection_state", "not_connected"}}.dump();
       }},
      {"rt/multiplestate", 1,
       [](Services services) {
         const json uwb = OrElse(SettingOf(services, "uwbswitch", "enable"), 0);
         return json{{"brightness", OrElse(SettingOf(services, "vui", "brightness"), 0)},
                     {"obstaclesAvoidSwitch",
                      OrElse(SettingOf(services, "obstacles_avoid", "enable"), false)},
                     {"uwbSwitch", uwb != 0},
                     {"volume", OrElse(SettingOf(services, "vui", "volume"), 0)}}
             .dump();
       }},
      {"rt/gnss", 1,
       [](Services) {
         return json{{"fixed", 0},           {"hdop", 0},
                     {"latitude", 0},        {"longitude", 0},
                     {"satellite_inuse", 0}, {"satellite_total", 0}}
             .dump();
       }},
      {"rt/audiohub/player/state", 4,
       [](Services) {
         return json{{"is_playing", false}, {"play_state", "not_in_use"}}.dump();
       }},
      {"rt/public_network_status", 1,
       [](Services) {
         return std::string(R"({"network_status": "NetworkStatus.ON_WIFI_CONNECTED"})");
       }},
  };
  return kRows;
}

StatusTexts::StatusTexts(const bus::Participant& participant,
                         const std::vector<std::string>& topics,
                         std::span<const std::unique_ptr<Service>> services)
    : services_(services),
      report_(participant, {"rt/servicestate", &std_msgs_msg_dds__String__desc}) {
  for (const std::string& topic : topics) {
    const auto row = std::ranges::find(Rows(), std::string_view(topic), &Row::topic);
    if (row == Rows().end()) {
      std::vector<std::string> words;
      for (const Row& known : Rows()) words.emplace_back(known.topic);
      throw ConfigError("robot.status_texts: no topic '" + topic + "'" + DidYouMean(topic, words));
    }
    outlets_.push_back({.writer = {participant, {topic.c_str(), &std_msgs_msg_dds__String__desc}},
                        .text = row->text,
                        .period = 1 / row->hz});
  }
}

void StatusTexts::Tell(const authority::MotorOwner& owner, double t) {
  for (Outlet& outlet : outlets_) {
    if (t < outlet.next - kSlack) continue;
    outlet.next = NextAfter(t, outlet.next, outlet.period);
    if (outlet.writer.has_readers()) Send(outlet.text(services_), &outlet.writer);
  }
  const authority::ProgramReport& report = owner.report();
  if (std::exchange(asked_, report.asked) != report.asked) {
    next_report_ = t;
    last_report_ = report.interval <= 0  ? -1
                   : report.duration > 0 ? t + report.duration
                                         : std::numeric_limits<double>::infinity();
  }
  if (t < next_report_ - kSlack || t > last_report_ + kSlack) return;
  next_report_ = NextAfter(t, next_report_, report.interval);
  if (report_.has_readers()) Send(ProgramList(owner.services()), &report_);
}

void StatusTexts::Send(std::string text, bus::Writer<std_msgs_msg_dds__String_>* writer) {
  writer->Write({.data = text.data()});
}

std::string ProgramList(std::span<const authority::OnboardService> services) {
  constexpr int kOn = 0, kOff = 1;  // [docs] Go2 RobotStateClient, [seen] on a robot
  json list = json::array();
  for (const authority::OnboardService& service : services) {
    json& entry = list.emplace_back(json{{"name", service.name},
                                         {"status", service.on ? kOn : kOff},
                                         {"protect", service.is_protected ? 1 : 0}});
    if (!service.version.empty()) entry["version"] = service.version;
  }
  return list.dump();
}

}  // namespace understudy::services
