#include "robot/firmware.h"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace understudy::robot {
namespace {

// Removes the first number and its dot; returns 0 if the text is empty.
int TakeNumber(std::string_view* version) {
  const std::size_t end = std::min(version->find('.'), version->size());
  int number = 0;
  std::from_chars(version->data(), version->data() + end, number);
  version->remove_prefix(std::min(end + 1, version->size()));
  return number;
}

}  // namespace

bool IsFirmware(std::string_view version) {
  constexpr std::size_t kLongestNumber = 8;
  std::size_t digits = 0;
  for (const char c : version) {
    if (c == '.') {
      if (digits == 0) return false;
      digits = 0;
    } else if (std::isdigit(static_cast<unsigned char>(c)) == 0 || ++digits > kLongestNumber) {
      return false;
    }
  }
  return digits > 0;
}

bool FirmwareReaches(std::string_view version, std::string_view since) {
  while (!version.empty() || !since.empty()) {
    const int have = TakeNumber(&version);
    const int need = TakeNumber(&since);
    if (have != need) return have > need;
  }
  return true;
}

bool HasService(std::string_view firmware, const ServiceSpec& service) {
  return (service.since.empty() || FirmwareReaches(firmware, service.since)) &&
         (service.before.empty() || !FirmwareReaches(firmware, service.before));
}

bool TellsStateId(const RobotSpec& spec) {
  return !spec.state_id_since.empty() && FirmwareReaches(spec.firmware, spec.state_id_since);
}

bool TellsRanges(const RobotSpec& spec) { return HasLidar(spec.lidar) && !TellsStateId(spec); }

}  // namespace understudy::robot
