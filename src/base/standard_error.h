// Standard error, which nobody may be reading.
#pragma once

#include <string_view>

namespace understudy {

// Writes the text, and never waits for long: a reader who has stopped reading (a full pipe, a
// terminal that is held) is waited for once, 0.2 s, and from then on not at all until it reads
// again. False where the text, or its end, is lost. Any thread.
bool WriteToStandardError(std::string_view text);

}  // namespace understudy
