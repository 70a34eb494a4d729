// Collects Cyclone's log lines. From the first participant on none of them reaches standard error.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::bus {

// A log line, and how many lines there were that differ from it only in numbers.
struct CycloneNotice {
  std::string line;
  std::uint64_t count = 1;

  std::string text() const {
    return count == 1 ? line : line + " (" + std::to_string(count) + " times)";
  }
};

// Returns the lines since the last call: of each kind the last one, newest last. Lines of one kind
// differ only in numbers. Beyond 16 kinds all others count as one. Any thread.
std::vector<CycloneNotice> TakeCycloneNotices();

// The samples of a topic that Cyclone received in this process and could not decode, since the
// first participant.
struct UndecodedSamples {
  // A writer's GUID, as other participants know it.
  using Writer = std::array<std::uint8_t, 16>;

  std::atomic<std::uint64_t> all{0};     // any thread may read it
  std::map<Writer, std::uint64_t> of{};  // under the log's lock
};

// The reference is valid until the process ends.
const UndecodedSamples& UndecodedOf(std::string_view topic);
// Returns how many came from each writer.
std::map<UndecodedSamples::Writer, std::uint64_t> UndecodedByWriter(std::string_view topic);

}  // namespace understudy::bus
