// Collects Cyclone's log lines. From the first participant on none of them reaches standard error.
#pragma once

#include <atomic>
#include <cstdint>
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

// Returns how many samples of a topic Cyclone received and could not decode since the first
// participant. The reference is valid until the process ends.
const std::atomic<std::uint64_t>& UndecodedSamples(std::string_view topic);

}  // namespace understudy::bus
