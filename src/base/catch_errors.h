// Turns exceptions into one line on standard error and an exit code.
#pragma once

#include <functional>

namespace understudy {

// Calls `run` and returns its result. If it throws, prints one line to standard error and returns
// the error's exit code.
int CatchErrors(const std::function<int()>& run);

// Opens /dev/null for each closed standard stream. Otherwise the next socket would get its number,
// and the log would be written to that socket. Call it before anything else is opened.
void OpenClosedStreams();

}  // namespace understudy
