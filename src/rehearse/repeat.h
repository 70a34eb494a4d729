// Tells whether two runs said the same.
#pragma once

#include <optional>
#include <string>

#include "record/recording_reader.h"

namespace understudy::rehearse {

// The first message in which two runs differ.
struct Difference {
  double at = 0;            // simulated s
  std::string text{};       // "message 951 of /lowcmd from client at 1.904 s: motor_cmd[3].q was
                            // 0.67, then 0.68"
  bool of_program = false;  // the program's message, or an event that says something of it
};

// Compares all messages of two recordings, topic by topic: their times since the start, and their
// bytes. Returns nullopt if they are the same. Throws RecordError.
std::optional<Difference> FirstDifference(const record::RecordingReader& first,
                                          const record::RecordingReader& second);

// What is known of two runs that differ.
struct Repeated {
  bool with_program = false;
  bool simulated_clock = false;
  bool realtime_priority = false;  // the threads have a core to themselves
  bool private_network = true;
  std::string unrepeatable{};  // the clock's own word, of either run; "" if it has none
};

// Returns the likeliest cause as one line, of what is known the surest first.
std::string CauseOf(const Difference& difference, const Repeated& runs);

}  // namespace understudy::rehearse
