#include "services/status_texts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <nlohmann/json.hpp>

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

// When a text is due again that was due at `due` and is published at t; some may have been left
// out.
double NextAfter(double t, double due, double period) {
  return due + period * std::max(1.0, std::ceil((t + kSlack - due) / period));
}

json OrElse(const json& value, const json& otherwise) {
  return value.is_null() ? otherwise : value;
}

}  // namespace

// Keys: seen on Go2 and G1 (docs/dev/sources.md#notes-on-real-robots). The values of multiplestate
// are the services' settings, as its keys say; that those of the others stay as they were seen,
// without a network, satellites or sound, is assumed.
struct StatusTexts::Row {
  wire::TopicName topic;
  Text text;
};

std::span<const StatusTexts::Row> StatusTexts::Rows() {
  static constexpr Row kRows[] = {
      {wire::topic::kRtcState,
       [](Services) {
         return json{{"connection_state", "not_connected"}}.dump();
       }},
      {wire::topic::kMultipleState,
       [](Services services) {
         const json uwb = OrElse(SettingOf(services, "uwbswitch", "enable"), 0);
         return json{{"brightness", OrElse(SettingOf(services, "vui", "brightness"), 0)},
                     {"obstaclesAvoidSwitch",
                      OrElse(SettingOf(services, "obstacles_avoid", "enable"), false)},
                     {"uwbSwitch", uwb != 0},
                     {"volume", OrElse(SettingOf(services, "vui", "volume"), 0)}}
             .dump();
       }},
      {wire::topic::kGnss,
       [](Services) {
         return json{{"fixed", 0},           {"hdop", 0},
                     {"latitude", 0},        {"longitude", 0},
                     {"satellite_inuse", 0}, {"satellite_total", 0}}
             .dump();
       }},
      {wire::topic::kAudioPlayerState,
       [](Services) {
         return json{{"is_playing", false}, {"play_state", "not_in_use"}}.dump();
       }},
      {wire::topic::kPublicNetworkStatus,
       [](Services) {
         return std::string(R"({"network_status": "NetworkStatus.ON_WIFI_CONNECTED"})");
       }},
  };
  return kRows;
}

StatusTexts::StatusTexts(wire::Outlets* outlets, std::span<const wire::RobotTopic> topics,
                         std::span<const std::unique_ptr<Service>> services)
    : services_(services) {
  for (const wire::RobotTopic& topic : topics) {
    Outlet* const outlet = outlets->Open<std_msgs_msg_dds__String_>(topic);
    const auto row = std::ranges::find(Rows(), std::string_view(topic.name),
                                       [](const Row& one) { return one.topic.name; });
    if (row != Rows().end()) texts_.push_back({.outlet = outlet, .text = row->text});
    report_ = outlet;
  }
}

void StatusTexts::Tell(const authority::MotorOwner& owner, double t) {
  for (Told& told : texts_) {
    if (t < told.next - kSlack) continue;
    told.next = NextAfter(t, told.next, 1 / told.outlet->topic().hz);
    if (told.outlet->has_readers()) Send(told.text(services_), told.outlet);
  }
  const authority::ProgramReport& report = owner.onboard().report;
  if (std::exchange(asked_, report.asked) != report.asked) {
    next_report_ = t;
    last_report_ = report.interval <= 0  ? -1
                   : report.duration > 0 ? t + report.duration
                                         : std::numeric_limits<double>::infinity();
  }
  if (t < next_report_ - kSlack || t > last_report_ + kSlack) return;
  next_report_ = NextAfter(t, next_report_, report.interval);
  if (report_->has_readers()) Send(ProgramList(owner.services()), report_);
}

void StatusTexts::Send(std::string text, Outlet* outlet) {
  std_msgs_msg_dds__String_ message{.data = text.data()};
  outlet->Send(&message);
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
