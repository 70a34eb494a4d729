// The keys of the configuration that can change while a robot runs, and why others cannot.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/result.h"
#include "emulator/settings.h"

namespace understudy::emulator {

struct Request;

// A key that can change between two steps, and where its value is. One of words is a bool there:
// the first word is false.
struct LiveSetting {
  std::string_view key;  // dotted, as in --set
  std::variant<bool*, double*> (*at)(WorldSettings& world, RobotSettings& robot);
};
std::span<const LiveSetting> LiveSettings();

// Keys that cannot change, each with all that begin like it.
struct FixedSetting {
  std::string_view begins;
  std::string_view why;
};
std::span<const FixedSetting> FixedSettings();

// Returns the place of a live key, or an Error that says why it cannot change and names the nearest
// one that can.
Result<std::size_t> FindSetting(std::string_view key);

// Returns the number that stands for the value of a request for `key`: itself, or the place of its
// word; or an Error with what was expected. Allocates only then.
Result<double> SettingNumber(const schema::Entry& key, const Request& request);

}  // namespace understudy::emulator
