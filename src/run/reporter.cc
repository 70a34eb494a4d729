#include "run/reporter.h"

#include <utility>

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include "base/standard_error.h"

namespace understudy::run {
namespace {

using emulator::EventLevel;
using std::chrono::milliseconds;

}  // namespace

Reporter::Reporter(const emulator::EventRing* events, double expected_hz, bool status_line,
                   std::vector<std::string> names)
    : events_(events),
      expected_hz_(expected_hz),
      names_(std::move(names)),
      status_line_(status_line) {}

Reporter::~Reporter() {
  LogEvents(updated_at_);
  const double seconds = std::chrono::duration<double>(updated_at_).count();
  for (const emulator::ToldEvent& told : digest_.Flush()) Say(told, seconds);
  for (const emulator::ToldEvent& told : slowness_.Flush()) Log(told);
  if (line_drawn_) WriteToStandardError("\r\033[K");
}

void Reporter::Update(const emulator::Status& status, WallTime now) {
  updated_at_ = now;
  LogEvents(now);
  if (status_line_) DrawStatusLine(status, now);
}

void Reporter::LogEvents(WallTime now) {
  const double seconds = std::chrono::duration<double>(now).count();
  for (emulator::Event event; events_.Next(&event);) {
    if (const auto told = digest_.Take(event, seconds)) Say(*told, seconds);
  }
  for (const emulator::ToldEvent& told : digest_.Due(seconds)) Say(told, seconds);
  for (const emulator::ToldEvent& told : slowness_.Due(seconds)) Log(told);
}

void Reporter::Log(const emulator::ToldEvent& told) const {
  const bool of_robot = !names_.empty() && !emulator::RowOf(told.event.kind).of_world;
  const std::string text = (of_robot ? names_[told.event.robot] + ": " : "") + told.text();
  switch (told.level()) {
    case EventLevel::kSilent:
      return;
    case EventLevel::kInfo:
      return spdlog::info("{}", text);
    case EventLevel::kWarning:
      return spdlog::warn("{}", text);
    case EventLevel::kError:
      return spdlog::error("{}", text);
  }
}

void Reporter::Say(const emulator::ToldEvent& told, double now) {
  using emulator::EventKind;
  // A machine that is too slow loses less than a second each second, one that stood still more.
  const bool slow = told.event.kind == EventKind::kOverrun ||
                    (told.event.kind == EventKind::kStall && told.event.numbers[0] < 1);
  if (!slow || told.level() == EventLevel::kSilent) return Log(told);
  if (const auto all = slowness_.Take(told, now)) Log(*all);
}

void Reporter::DrawStatusLine(const emulator::Status& status, WallTime now) {
  const bool started = line_drawn_ || status.loop.pace.real_time_factor > 0;
  if (started && now - drawn_at_ < milliseconds(500)) return;
  if (started) {
    const double wall = std::chrono::duration<double>(now - drawn_at_).count();
    const auto rate = [wall](std::uint64_t to, std::uint64_t from) {
      return static_cast<double>(to - from) / wall;
    };
    const double factor = (status.time - drawn_.time) / wall;
    WriteToStandardError(fmt::format(
        "\r\033[K{:.1f} s  x{:.2f}  LowState {:.0f}/s of {:.0f}  LowCmd {:.0f}/s  {}{}{}",
        status.time, factor, rate(status.published, drawn_.published), expected_hz_ * factor,
        rate(status.commands.accepted, drawn_.commands.accepted), authority::Name(status.gate),
        status.paused ? "  PAUSED" : "", status.silenced ? "  SILENCED" : ""));
    line_drawn_ = true;
  }
  drawn_at_ = now;
  drawn_ = status;
}

}  // namespace understudy::run
