#include "server/snapshot_json.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <concepts>
#include <iterator>
#include <ranges>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "emulator/request.h"
#include "robot/damage_reached.h"
#include "robot/remote_keys.h"
#include "server/http.h"

namespace understudy::server {
namespace {

// Numbers with all their digits.
struct Exact {
  double number;
};
struct ExactList {
  const std::vector<double>& numbers;
};

// An IMU without its temperature, which is not simulated truth.
struct TrueImu {
  const robot::ImuReading& reading;
};

std::vector<std::string_view> ErrorsOf(const robot::MotorReading& motor) {
  std::vector<std::string_view> errors;
  if (motor.overheated) errors.emplace_back("overheated");
  if (motor.undervoltage) errors.emplace_back("undervoltage");
  if (motor.encoder_error) errors.emplace_back("encoder");
  if (motor.silent) errors.emplace_back("silent");
  return errors;
}

// Writes straight into text, since snapshots go out many times a second.
class Writer {
 public:
  Writer(const emulator::Snapshot& snapshot, emulator::SnapshotParts parts)
      : snapshot_(snapshot), parts_(parts & snapshot.parts) {}

  std::string Write() {
    PutMembers("step", snapshot_.step, "time", Exact{snapshot_.time}, "speed", snapshot_.speed,
               "paused", snapshot_.paused);
    PutPart(emulator::kPartPositions, ExactList{snapshot_.positions});
    PutPart(emulator::kPartBodies, snapshot_.bodies);
    PutPart(emulator::kPartContacts, snapshot_.contacts);
    PutPart(emulator::kPartCom, snapshot_.com);
    PutPart(emulator::kPartCrane, snapshot_.crane);
    PutPart(emulator::kPartPushes, snapshot_.pushes);
    PutPart(emulator::kPartMotors, snapshot_.motors);
    PutPart(emulator::kPartImus, std::span(snapshot_.imus).first(snapshot_.imu_count));
    PutPart(emulator::kPartBattery, snapshot_.battery);
    PutPart(emulator::kPartFeet, snapshot_.feet);
    PutPart(emulator::kPartRemote, snapshot_.remote);
    PutPart(emulator::kPartWirelessRemote, snapshot_.wireless_remote);
    PutPart(emulator::kPartCommand, snapshot_.command);
    PutPart(emulator::kPartFaults, snapshot_.faults);
    PutPart(emulator::kPartDamage, snapshot_.damage);
    PutPart(emulator::kPartMotion, snapshot_.motion);
    PutPart(emulator::kPartTruth, snapshot_.truth);
    PutPart(emulator::kPartTouch, snapshot_.touch);
    Close('}');
    return std::move(text_);
  }

 private:
  // Each is followed by a comma, of which the end of a list or object makes its bracket.
  template <class Value, class... Rest>
  void PutMembers(std::string_view key, const Value& value, const Rest&... rest) {
    ((text_ += '"') += key) += "\":";
    Put(value);
    text_ += ',';
    if constexpr (sizeof...(rest) > 0) PutMembers(rest...);
  }
  template <class... Members>
  void PutObject(const Members&... members) {
    text_ += '{';
    PutMembers(members...);
    Close('}');
  }
  template <std::ranges::range Values>
  void Put(const Values& values) {
    text_ += '[';
    for (const auto& value : values) {
      Put(value);
      text_ += ',';
    }
    Close(']');
  }
  void Close(char bracket) {
    if (text_.back() == ',') text_.pop_back();
    text_ += bracket;
  }

  template <class Number>
  void PutNumber(Number number) {
    char digits[32];
    const char* const end = std::to_chars(std::begin(digits), std::end(digits), number).ptr;
    text_ += std::isfinite(number) ? std::string_view(digits, end) : "null";
  }
  void Put(const Exact& exact) { PutNumber(exact.number); }
  void Put(const ExactList& list) {
    text_ += '[';
    for (const double number : list.numbers) {
      PutNumber(number);
      text_ += ',';
    }
    Close(']');
  }
  // A float's precision in its fewest digits: half the text.
  void Put(double number) { PutNumber(static_cast<float>(number)); }
  void Put(std::integral auto number) { PutNumber(number); }
  void Put(bool is) { text_ += is ? "true" : "false"; }
  void Put(const std::string& text) { text_ += JsonText(text); }
  void Put(const Eigen::Vector3d& vector) { Put(std::span(vector.data(), 3)); }
  void Put(const Eigen::Quaterniond& q) { Put(std::array{q.w(), q.x(), q.y(), q.z()}); }

  void Put(const physics::ContactReading& contact) {
    PutObject("at", contact.at, "force", contact.force, "geoms", contact.geoms, "bodies",
              contact.bodies);
  }
  void Put(const emulator::SnapshotCrane& crane) {
    PutObject("attached", crane.attached, "hook", crane.hook, "top", crane.top, "tension",
              crane.tension);
  }
  void Put(const emulator::SnapshotPush& push) {
    PutObject("body", snapshot_.body_names[static_cast<std::size_t>(push.body)], "at", push.at,
              "force", push.force);
  }
  void Put(const robot::MotorReading& motor) {
    PutObject("q", motor.q, "dq", motor.dq, "tau", motor.tau, "casing", motor.casing_c, "winding",
              motor.winding_c, "mode", motor.enabled ? 1 : 0, "errors", ErrorsOf(motor), "enabled",
              motor.enabled, "lost", motor.lost);
  }
  void Put(const robot::ImuReading& imu) {
    PutObject("quaternion", imu.R_WI, "gyroscope", imu.w_WI_I, "accelerometer", imu.f_WI_I,
              "temperature", imu.temperature_c);
  }
  void Put(const robot::BatteryReading& battery) {
    PutObject("voltage", battery.voltage, "current", battery.current, "soc", battery.soc,
              "temperature", battery.temperature_c);
  }
  void Put(const robot::RemoteReading& remote) {
    PutObject("there", remote.there, "keys", robot::RemoteKeyNames(remote.keys), "lx", remote.lx,
              "ly", remote.ly, "rx", remote.rx, "ry", remote.ry);
  }
  void Put(const robot::MotorCommand& command) {
    PutObject("q", command.q, "dq", command.dq, "kp", command.kp, "kd", command.kd, "tau",
              command.tau, "enabled", command.enabled);
  }

  void Put(std::string_view text) { text_ += JsonText(text); }
  void Put(const emulator::SnapshotMotion& motion) {
    PutObject("service", std::string_view(motion.service.data()), "state", motion.state, "name",
              motion.name);
  }
  void Put(const TrueImu& unit) {
    PutObject("quaternion", unit.reading.R_WI, "gyroscope", unit.reading.w_WI_I, "accelerometer",
              unit.reading.f_WI_I);
  }
  void Put(const robot::TrueValues& truth) {
    const std::array units{TrueImu{truth.imu}, TrueImu{truth.secondary_imu}};
    PutObject("q", truth.q, "dq", truth.dq, "tau", truth.tau, "imus",
              std::span(units).first(snapshot_.imu_count), "feet", truth.foot_force);
  }
  void Put(const emulator::SnapshotFault& fault) {
    PutObject("component", snapshot_.components[fault.component], "fault", fault.kind->name, "by",
              fault.by, "unit", fault.kind->unit, "from", Exact{fault.from});
  }
  void Put(const robot::DamageTotals& damage) {
    PutObject("time", Exact{damage.time}, "energy", damage.energy, "peak_current",
              damage.peak_current, "shock", damage.shock, "worst_tilt", damage.worst_tilt, "falls",
              damage.falls, "trip", snapshot_.trip_c, "motors", damage.motors, "limits",
              snapshot_.damage_limits);
  }
  void Put(const robot::MotorDamage& motor) {
    const auto i = static_cast<std::size_t>(&motor - snapshot_.damage.motors.data());
    PutObject("joint", snapshot_.motor_names[i], "at_torque_limit", motor.at_torque_limit,
              "torque_limit", snapshot_.limits[i].torque, "at_speed_limit", motor.at_speed_limit,
              "speed_limit", snapshot_.limits[i].speed, "tripped", motor.tripped, "hottest",
              motor.hottest_c, "hardest_stop", motor.hardest_stop, "largest_jump",
              motor.largest_jump, "jump_limit", snapshot_.limits[i].jump, "mark",
              NameOf(WorstMark(motor, snapshot_.limits[i], snapshot_.damage_limits)));
  }
  void Put(const robot::DamageLimit& limit) {
    const robot::DamageReached reached = ReachedOf(limit, snapshot_.damage, snapshot_.limits);
    PutObject("figure", limit.figure, "limit", limit.limit, "unit", limit.unit, "source",
              limit.source, "reached", reached.value, "reached_unit", reached.unit, "held_against",
              reached.limit, "motor",
              reached.motor ? std::string_view(snapshot_.motor_names[*reached.motor]) : "", "mark",
              NameOf(reached.mark));
  }

  template <class Value>
  void PutPart(emulator::SnapshotPart part, const Value& value) {
    const auto place = static_cast<std::size_t>(std::countr_zero<std::uint32_t>(part));
    if ((parts_ & part) != 0) PutMembers(emulator::kSnapshotParts[place].name, value);
  }

  const emulator::Snapshot& snapshot_;
  emulator::SnapshotParts parts_;
  std::string text_ = "{";
};

}  // namespace

std::optional<emulator::SnapshotParts> ReadSnapshotParts(std::string_view list,
                                                         std::string* unknown) {
  emulator::SnapshotParts parts = 0;
  while (!list.empty()) {
    const std::string_view word = list.substr(0, list.find(','));
    list.remove_prefix(std::min(list.size(), word.size() + 1));
    const auto* found =
        std::find_if(std::begin(emulator::kSnapshotParts), std::end(emulator::kSnapshotParts),
                     [&](const emulator::SnapshotPartName& part) { return part.name == word; });
    if (found == std::end(emulator::kSnapshotParts)) {
      *unknown = word;
      return std::nullopt;
    }
    parts |= found->part;
  }
  return parts;
}

nlohmann::ordered_json SettingsJson(const emulator::Snapshot& snapshot) {
  nlohmann::ordered_json settings = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < snapshot.settings.size(); ++i) {
    const schema::Entry& key = snapshot.setting_keys[i];
    const double value = snapshot.settings[i];
    nlohmann::ordered_json shown = value;
    if (key.type == &schema::kSwitch) {
      shown = value != 0;
    } else if (!key.words.empty()) {
      shown = key.words[static_cast<std::size_t>(value)];
    }
    settings.push_back({{"key", key.key},
                        {"value", shown},
                        {"unit", key.unit},
                        {"takes", key.expected},
                        {"does", key.does}});
    if (key.key == "terrain.friction" && value == 0) {
      const auto [least, most] = snapshot.ground_friction;
      settings.back()["stands_for"] =
          emulator::NumberText(least) + (most > least ? " to " + emulator::NumberText(most) : "");
    }
  }
  return {{"settings", settings}};
}

nlohmann::ordered_json FaultsJson(const emulator::Snapshot& snapshot) {
  using nlohmann::ordered_json;
  ordered_json components = ordered_json::array(), kinds = ordered_json::array();
  std::set<const robot::FaultKind*> told;
  for (std::size_t i = 0; i < snapshot.components.size(); ++i) {
    if (snapshot.component_faults[i].empty()) continue;
    ordered_json names = ordered_json::array();
    for (const robot::FaultKind* kind : snapshot.component_faults[i]) {
      names.push_back(kind->name);
      if (!told.insert(kind).second) continue;
      kinds.push_back({{"of", NameOf(kind->of)},
                       {"fault", kind->name},
                       {"does", kind->does},
                       {"unit", kind->unit},
                       {"range", nullptr},
                       {"default", nullptr}});
      if (!kind->has_magnitude()) continue;
      kinds.back()["range"] = {kind->low, kind->high};
      kinds.back()["default"] = kind->otherwise;
    }
    components.push_back({{"name", snapshot.components[i]},
                          {"of", NameOf(snapshot.component_faults[i].front()->of)},
                          {"faults", names}});
  }
  return {{"components", components}, {"kinds", kinds}};
}

std::string SnapshotJson(const emulator::Snapshot& snapshot, emulator::SnapshotParts parts) {
  return Writer(snapshot, parts).Write();
}

}  // namespace understudy::server
