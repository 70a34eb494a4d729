// Writes to standard error without waiting for a reader that has stopped reading.
#pragma once

#include <string_view>

namespace understudy {

// Writes the text. If the reader has stopped reading (a full pipe, a suspended terminal) it waits
// once for 0.2 s, and then not at all until the reader continues. Returns false if the text or its
// end is lost. Any thread.
bool WriteToStandardError(std::string_view text);

}  // namespace understudy
