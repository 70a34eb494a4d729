// The list of faults that a Go2 tells on rt/errorlist.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::wire {

// The text {"errors":[[timestamp, source, code], ...]} with one entry for each bit that is set
// (vendor, Go2 fault services):
//
//   100        the bits of bit_flag that report faults
//   200        fans, the bits of fan_frequency[3]
//   300 + i    the motor in slot i, the bits of its reserve[0]
//   600        motion control: 4 its protection from heat, 8 that from low charge (the vendor's
//   app)
//
// Timestamps are whole s since the start, when the entry came; that, and when it is sent, is
// *assumed*. Does not allocate.
class ErrorList {
 public:
  // `spec` must outlive it.
  explicit ErrorList(const robot::RobotSpec& spec) : spec_(&spec) {}

  // Takes a state, none older than the one before. Returns whether the list is to be sent: it has
  // changed, or it is not empty and was last sent a second ago.
  bool Update(const robot::RobotState& state);

  // Returns the text of the last list that was to be sent, "" before.
  char* text() { return text_.data(); }

 private:
  struct Entry {
    std::int64_t since = 0;  // s
    std::uint32_t source = 0, code = 0;
  };
  struct List {
    std::array<Entry, 160> entries{};
    std::size_t count = 0;
  };

  void Add(std::uint32_t source, std::uint32_t word, std::int64_t now, List* list) const;
  void Write();

  const robot::RobotSpec* spec_;
  List told_;
  std::int64_t sent_ms_ = 0;
  std::array<char, 160 * 32 + 16> text_{};
};

}  // namespace understudy::wire
