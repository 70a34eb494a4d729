#include "wire/error_list.h"

#include <algorithm>
#include <cstdio>

#include "wire/go_codec.h"
#include "wire/motor_errors.h"

namespace understudy::wire {
namespace {

constexpr std::int64_t kAgain_ms = 1000;
constexpr std::uint32_t kBottom = 100, kFans = 200, kMotors = 300, kMotion = 600;
constexpr std::uint32_t kHot = 0x04, kLowCharge = 0x08;  // of kMotion

bool Protects(const robot::RobotState& state, robot::Danger danger) {
  return state.motion &&
         state.motion->dangers[static_cast<std::size_t>(danger)].does > robot::Protection::kNothing;
}

}  // namespace

void ErrorList::Add(std::uint32_t source, std::uint32_t word, std::int64_t now, List* list) const {
  for (std::uint32_t left = word; left != 0; left &= left - 1) {
    if (list->count == list->entries.size()) return;
    const Entry entry{now, source, left & (~left + 1)};
    const auto same = [&](const Entry& one) {
      return one.source == entry.source && one.code == entry.code;
    };
    const auto end = told_.entries.begin() + static_cast<std::ptrdiff_t>(told_.count);
    const auto before = std::find_if(told_.entries.begin(), end, same);
    list->entries[list->count++] = before == end ? entry : *before;
  }
}

bool ErrorList::Update(const robot::RobotState& state) {
  const std::int64_t now = state.tick_ms / 1000;
  List list;
  Add(kBottom, BottomFaults(state), now, &list);
  Add(kFans, state.board.stalled, now, &list);
  for (std::size_t i = 0; i < spec_->motors.size(); ++i) {
    Add(kMotors + static_cast<std::uint32_t>(spec_->motors[i].slot),
        ErrorsOf(state.motors[i], kGoMotorErrors), now, &list);
  }
  Add(kMotion,
      (Protects(state, robot::Danger::kHeat) ? kHot : 0) |
          (Protects(state, robot::Danger::kCharge) ? kLowCharge : 0),
      now, &list);
  const auto alike = [](const Entry& a, const Entry& b) {
    return a.source == b.source && a.code == b.code;
  };
  const std::span entries(list.entries.data(), list.count);
  const bool changed =
      !std::ranges::equal(entries, std::span(told_.entries.data(), told_.count), alike);
  const bool again = list.count > 0 && state.tick_ms - sent_ms_ >= kAgain_ms;
  if (!changed && !again) return false;
  told_ = list;
  sent_ms_ = state.tick_ms;
  Write();
  return true;
}

void ErrorList::Write() {
  std::size_t length = 0;
  const auto print = [&](const char* format, auto... values) {
    const std::span<char> rest = std::span(text_).subspan(length);
    const int written = std::snprintf(rest.data(), rest.size(), format, values...);
    length = std::min(text_.size() - 1, length + static_cast<std::size_t>(std::max(0, written)));
  };
  print("%s", "{\"errors\":[");
  for (std::size_t i = 0; i < told_.count; ++i) {
    const Entry& entry = told_.entries[i];
    print("%s[%lld,%u,%u]", i == 0 ? "" : ",", static_cast<long long>(entry.since), entry.source,
          entry.code);
  }
  print("%s", "]}");
}

}  // namespace understudy::wire
