#include "server/metrics.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string_view>
#include <utility>

namespace understudy::server {
namespace {

std::string Text(double number) {
  if (std::isnan(number)) return "NaN";
  if (std::isinf(number)) return number > 0 ? "+Inf" : "-Inf";
  char digits[32];
  return {digits, std::to_chars(std::begin(digits), std::end(digits), number).ptr};
}

// Escapes a label's value for the format.
std::string Escaped(std::string_view value) {
  std::string text;
  for (const char c : value) {
    if (c == '\n') {
      text += "\\n";
      continue;
    }
    if (c == '\\' || c == '"') text += '\\';
    text += c;
  }
  return text;
}

// Of what others on the network call themselves, which need not be the format's UTF-8.
std::string Ascii(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) > 0x7e) c = '?';
  }
  return text;
}

std::string Label(std::string_view name, std::string_view value) {
  return std::string{name} + "=\"" + Escaped(value) + "\"";
}

// Writes the families of metrics.
class Page {
 public:
  // All samples have the label `common`, "" for none.
  explicit Page(std::string common) : common_(std::move(common)) {}

  void Family(std::string_view name, std::string_view type, std::string_view help) {
    name_ = "understudy_" + std::string{name};
    text_ += "# HELP " + name_ + " " + std::string{help} + "\n# TYPE " + name_ + " " +
             std::string{type} + "\n";
  }
  // Adds a sample to the family.
  void Add(double value, const std::string& labels = "", std::string_view suffix = "") {
    Put(Text(value), labels, suffix);
  }
  void Add(std::uint64_t value, const std::string& labels = "", std::string_view suffix = "") {
    Put(std::to_string(value), labels, suffix);
  }

  void Counter(std::string_view name, std::string_view help, std::uint64_t value) {
    Family(name, "counter", help);
    Add(value);
  }
  void Gauge(std::string_view name, std::string_view help, double value) {
    Family(name, "gauge", help);
    Add(value);
  }
  void Distribution(std::string_view name, std::string_view help,
                    const time::Histogram& histogram) {
    Family(name, "histogram", help);
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
      count += histogram.counts[i];
      const double bound = i < time::kHistogramBounds.size() ? time::kHistogramBounds[i] : INFINITY;
      Add(count, Label("le", Text(bound)), "_bucket");
    }
    Add(histogram.sum, "", "_sum");
    Add(count, "", "_count");
  }

  std::string Take() { return std::move(text_); }

 private:
  void Put(const std::string& value, const std::string& labels, std::string_view suffix) {
    const std::string all = common_ + (common_.empty() || labels.empty() ? "" : ",") + labels;
    text_ +=
        name_ + std::string{suffix} + (all.empty() ? "" : "{" + all + "}") + " " + value + "\n";
  }

  std::string common_;
  std::string name_;
  std::string text_;
};

void AddPace(const emulator::Status& status, Page* page) {
  page->Counter("steps_total", "Physics steps made.", static_cast<std::uint64_t>(status.steps));
  page->Gauge("simulated_seconds", "Simulated time since the start.", status.time);
  page->Gauge("speed", "Simulated seconds wanted per wall second; 0 is as fast as possible.",
              status.speed);
  page->Gauge("real_time_factor", "Simulated seconds per wall second over the last second.",
              status.loop.pace.real_time_factor);
  page->Gauge("paused", "1 while the robot is paused.", status.paused ? 1 : 0);
  page->Counter("overruns_total", "Ticks that began more than one period late.",
                status.loop.pace.overruns);
  page->Distribution("lateness_seconds", "How late ticks began.", status.loop.pace.latenesses);
  page->Distribution("tick_seconds", "How long ticks took.", status.loop.ticks);
  page->Counter("divergences_total", "Times that the physics diverged.", status.divergences);
}

template <class PutOne>
void ForEachTopic(const emulator::Status& status, const emulator::Snapshot& snapshot, PutOne put) {
  for (std::size_t i = 0; i < snapshot.command_topics.size(); ++i) {
    if (snapshot.command_topics[i].empty()) continue;
    put(snapshot.command_topics[i], emulator::CommandCounts(status, i));
  }
}

void AddCommands(const emulator::Status& status, const emulator::Snapshot& snapshot, Page* page) {
  page->Family("commands_taken_total", "counter", "Commands that the robot took.");
  ForEachTopic(status, snapshot, [&](std::string_view topic, const authority::GateCounts& counts) {
    page->Add(counts.accepted, Label("topic", topic));
  });
  page->Family("commands_refused_total", "counter", "Commands that the robot refused.");
  ForEachTopic(status, snapshot, [&](std::string_view topic, const authority::GateCounts& counts) {
    for (std::size_t i = 1; i < robot::kRefusals; ++i) {
      page->Add(counts.refused[i],
                Label("topic", topic) + "," +
                    Label("reason", robot::Name(static_cast<robot::Refusal>(i))));
    }
  });
  page->Family("command_timeouts_total", "counter", "Times that commands stopped coming.");
  ForEachTopic(status, snapshot, [&](std::string_view topic, const authority::GateCounts& counts) {
    page->Add(counts.timeouts, Label("topic", topic));
  });
  page->Counter("states_published_total", "LowState samples sent.", status.published);
  page->Counter("write_failures_total", "Messages that the bus did not take.",
                status.port.write_failures);
  page->Counter("service_requests_total", "Requests to services.", status.services.requests);
  page->Family("service_refusals_total", "counter", "Requests that were refused or ignored.");
  for (std::size_t i = 1; i < services::kCallRefusals; ++i) {
    page->Add(status.services.refused[i],
              Label("reason", services::Name(static_cast<services::CallRefusal>(i))));
  }
  page->Counter("service_replies_lost_total", "Replies that nobody could be sent.",
                status.services.lost_replies);
}

void AddEvents(const EventHistory& events, Page* page) {
  page->Family("events_total", "counter", "Events by kind.");
  for (const emulator::EventRow& row : emulator::EventTable()) {
    page->Add(events.counts()[static_cast<std::size_t>(row.kind)], Label("kind", row.name));
  }
  page->Family(
      "unmatched_writers_total", "counter",
      "Writers from which nothing arrives, with the policy or type that keeps them apart.");
  for (const auto& [writer, count] : events.unmatched()) {
    page->Add(count, Label("writer", Ascii(writer)));
  }
}

void AddMotors(const emulator::Snapshot& snapshot, Page* page) {
  const auto all = [&](std::string_view name, std::string_view help,
                       double robot::MotorReading::*value) {
    page->Family(name, "gauge", help);
    for (std::size_t i = 0; i < snapshot.motors.size(); ++i) {
      page->Add(snapshot.motors[i].*value, Label("motor", snapshot.motor_names[i]));
    }
  };
  all("motor_torque_newton_metres", "Torque that the motor gives.", &robot::MotorReading::tau);
  all("motor_casing_celsius", "Temperature of the motor's casing.", &robot::MotorReading::casing_c);
  all("motor_winding_celsius", "Temperature of the motor's winding.",
      &robot::MotorReading::winding_c);
}

void AddBattery(const robot::BatteryReading& battery, Page* page) {
  page->Gauge("battery_volts", "Voltage of the battery.", battery.voltage);
  page->Gauge("battery_amperes", "Current of the battery, negative while it gives.",
              battery.current);
  page->Gauge("battery_charge_ratio", "Charge of the battery, 0 to 1.", battery.soc);
}

}  // namespace

std::string MetricsText(const RobotIdentity& identity, const emulator::Status& status,
                        const emulator::Snapshot& snapshot, const EventHistory& events) {
  // One of several robots is known by its name, in all samples.
  const bool alone = identity.name.empty();
  Page page(alone ? "" : Label("robot", identity.name));
  page.Family("info", "gauge", "Which robot this is; always 1.");
  page.Add(std::uint64_t{1}, Label(alone ? "robot" : "type", identity.robot) + "," +
                                 Label("version", identity.version));
  AddPace(status, &page);
  AddCommands(status, snapshot, &page);
  AddEvents(events, &page);
  AddMotors(snapshot, &page);
  AddBattery(snapshot.battery, &page);
  return page.Take();
}

}  // namespace understudy::server
