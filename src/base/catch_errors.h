// Turns exceptions into one line on stderr and an exit code, for every program here.
#ifndef UNDERSTUDY_BASE_CATCH_ERRORS_H_
#define UNDERSTUDY_BASE_CATCH_ERRORS_H_

#include <functional>

namespace understudy {

// What `run` returns, or the exit code of what it threw, which standard error then tells in a line.
int CatchErrors(const std::function<int()>& run);

// A standard stream that our caller closed would give its number to the next socket, and the log
// would be written into that: opens those that are closed. Before anything else is opened.
void OpenClosedStreams();

}  // namespace understudy

#endif  // UNDERSTUDY_BASE_CATCH_ERRORS_H_
