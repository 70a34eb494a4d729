// Turns exceptions into one line on stderr and an exit code, for every program here.
#pragma once

#include <functional>

namespace understudy {

// What `run` returns, or the exit code of what it threw, which standard error then tells in a line.
int CatchErrors(const std::function<int()>& run);

// A standard stream that our caller closed would give its number to the next socket, and the log
// would be written into that: opens those that are closed. Before anything else is opened.
void OpenClosedStreams();

}  // namespace understudy
