// What Cyclone says by itself. From the first participant on, until the process ends, none of it
// reaches standard error.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::bus {

// A line of Cyclone's, and how many there were that differ from it in numbers only.
struct CycloneNotice {
  std::string line;
  std::uint64_t count = 1;

  std::string text() const {
    return count == 1 ? line : line + " (" + std::to_string(count) + " times)";
  }
};

// What was said since this was last called, the last line of each kind, newest last, at most 16
// kinds; what there is beyond is counted as one more. Any thread.
std::vector<CycloneNotice> TakeCycloneNotices();

// The samples of a topic that Cyclone received and could not decode, since the
// first participant. Valid for the rest of the process.
const std::atomic<std::uint64_t>& UndecodedSamples(std::string_view topic);

}  // namespace understudy::bus
