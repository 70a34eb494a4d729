// Tells whether two runs said the same.
#pragma once

#include <string>

#include "record/recording_reader.h"

namespace understudy::rehearse {

// Compares all messages of two recordings, topic by topic: their times since the start, and their
// bytes. Returns what differs first, "message 951 of /lowcmd from client at 1.904 s: motor_cmd[3].q
// was 0.67, then 0.68"; "" if nothing does. Throws RecordError.
std::string FirstDifference(const record::RecordingReader& first,
                            const record::RecordingReader& second);

}  // namespace understudy::rehearse
