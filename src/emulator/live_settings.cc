#include "emulator/live_settings.h"

#include <algorithm>

#include "base/nearest_word.h"
#include "emulator/request.h"

namespace understudy::emulator {
namespace {

using Place = std::variant<bool*, double*>;

// Names a value after its members, which are those of its key.
#define UNDERSTUDY_LIVE_ROBOT(key, member)                                   \
  LiveSetting {                                                              \
    key, [](WorldSettings&, RobotSettings& r) -> Place { return &r.member; } \
  }
#define UNDERSTUDY_LIVE_SENSOR(member) UNDERSTUDY_LIVE_ROBOT("sensors." #member, sensors.member)

constexpr LiveSetting kLive[] = {
    {"terrain.friction",
     [](WorldSettings& w, RobotSettings&) -> Place { return &w.ground_friction; }},
    {"physics.on_divergence",
     [](WorldSettings& w, RobotSettings&) -> Place { return &w.reset_on_divergence; }},
    UNDERSTUDY_LIVE_SENSOR(quantise),
    UNDERSTUDY_LIVE_SENSOR(noise),
    UNDERSTUDY_LIVE_SENSOR(noise_gain),
    UNDERSTUDY_LIVE_SENSOR(imu.gyro_bias),
    UNDERSTUDY_LIVE_SENSOR(imu.gyro_walk),
    UNDERSTUDY_LIVE_SENSOR(imu.gyro_scale),
    UNDERSTUDY_LIVE_SENSOR(imu.gyro_misalignment),
    UNDERSTUDY_LIVE_SENSOR(imu.accel_bias),
    UNDERSTUDY_LIVE_SENSOR(imu.accel_walk),
    UNDERSTUDY_LIVE_SENSOR(imu.accel_scale),
    UNDERSTUDY_LIVE_SENSOR(imu.accel_misalignment),
    UNDERSTUDY_LIVE_SENSOR(imu.saturate),
    UNDERSTUDY_LIVE_SENSOR(imu.bandwidth),
    UNDERSTUDY_LIVE_SENSOR(imu.attitude_gain),
    UNDERSTUDY_LIVE_SENSOR(imu.attitude_trim),
    UNDERSTUDY_LIVE_SENSOR(imu.warm_up),
    UNDERSTUDY_LIVE_SENSOR(foot.offset),
    UNDERSTUDY_LIVE_SENSOR(foot.walk),
    UNDERSTUDY_LIVE_SENSOR(foot.scale),
    UNDERSTUDY_LIVE_SENSOR(foot.cross_talk),
    UNDERSTUDY_LIVE_SENSOR(thermometer.time_constant),
    UNDERSTUDY_LIVE_SENSOR(thermometer.offset_c),
    UNDERSTUDY_LIVE_SENSOR(odometer.scale),
    UNDERSTUDY_LIVE_SENSOR(odometer.walk),
    UNDERSTUDY_LIVE_SENSOR(odometer.shortfall),
    UNDERSTUDY_LIVE_SENSOR(odometer.turn),
    UNDERSTUDY_LIVE_ROBOT("gate.mode", gate.lenient),
    UNDERSTUDY_LIVE_ROBOT("gate.timeout", gate.timeout),
    UNDERSTUDY_LIVE_ROBOT("motion.fight", motion.fight),
    UNDERSTUDY_LIVE_ROBOT("crane.damping", crane.damping),
    UNDERSTUDY_LIVE_ROBOT("crane.speed", crane.speed),
};

#undef UNDERSTUDY_LIVE_SENSOR
#undef UNDERSTUDY_LIVE_ROBOT

constexpr FixedSetting kFixed[] = {
    {"profile", "it stands for the keys of sensors, which can"},
    {"scene", "it is part of the compiled model"},
    {"objects", "they are part of the compiled model; the request `object` moves one"},
    {"look", "the robot is drawn by it from the start"},
    {"terrain.", "it is part of the compiled model"},
    {"network.", "its sockets are open"},
    {"guard.", "it is for the start and for a thread that watches the network"},
    {"control.", "its sockets are open"},
    {"time.speed", "the request `speed` changes it"},
    {"time.", "it is for the start"},
    {"recording.", "its topics are announced at the start"},
    {"physics.contacts", "it is part of the compiled model"},
    {"physics.timestep", "rates, delays and filters are counted in it"},
    {"sensors.seed", "what is drawn has been drawn from it"},
    {"sensors.imu.attitude", "a filter that has not run knows no attitude"},
    {"sensors.imu.latency", "readings under way would be lost"},
    {"sensors.odometer.legs", "the way so far is that of the one or of the other"},
    {"sensors.encoder.", "`fault JOINT.encoder offset` does that"},
    {"gate.damping_kd", "commands made at the start have it"},
    {"motion.service", "`service.call motion_switcher` changes it"},
    {"faults", "`fault` has something fail while the robot runs"},
    {"crane.length", "`crane.lower` and `crane.raise` change it"},
    {"crane.stiffness", "a robot that hangs would jump"},
    {"start.", "the run has started; `reset` puts the robot into a pose"},
    {"randomization.", "what is drawn at random is drawn at the start"},
    {"robot.", "model, motors and messages are made of it; `fault` changes what a component does"},
};

}  // namespace

std::span<const LiveSetting> LiveSettings() { return kLive; }

std::span<const FixedSetting> FixedSettings() { return kFixed; }

Result<std::size_t> FindSetting(std::string_view key) {
  const auto* const live = std::ranges::find(kLive, key, &LiveSetting::key);
  if (live != std::end(kLive)) return static_cast<std::size_t>(live - std::begin(kLive));
  std::vector<std::string> keys;
  for (const LiveSetting& one : kLive) keys.emplace_back(one.key);
  const std::string hint = NearestHint(key, keys);
  const auto* const fixed = std::ranges::find_if(
      kFixed, [&](const FixedSetting& one) { return key.starts_with(one.begins); });
  const std::string got =
      "expected a key that can change, got " + schema::Node(nlohmann::json(key)).shown();
  if (fixed != std::end(kFixed)) return Error{got + ": " + std::string(fixed->why) + hint};
  return Error{got + (hint.empty() ? "; `ctl set` lists them" : hint)};
}

Result<double> SettingNumber(const schema::Entry& key, const Request& request) {
  const std::string_view text = request.setting();
  if (text.empty()) {
    const double number = request.number("value");
    if (key.words.empty() && number >= key.range.min && number <= key.range.max) return number;
    return Error{key.key + ": expected " + key.expected + ", got " + NumberText(number)};
  }
  const std::string_view word = key.type != &schema::kSwitch ? text
                                : text == "on"               ? "true"
                                : text == "off"              ? "false"
                                                             : text;
  const auto found = std::ranges::find(key.words, word);
  if (found != key.words.end()) return static_cast<double>(found - key.words.begin());
  return Error{key.key + ": expected " + key.expected + ", got " +
               schema::Node(nlohmann::json(text)).shown() + NearestHint(text, key.words)};
}

}  // namespace understudy::emulator
