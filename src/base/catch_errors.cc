#include "base/catch_errors.h"

#include <exception>

#include <fcntl.h>
#include <unistd.h>

#include "base/errors.h"
#include "base/log_line.h"

namespace understudy {
int CatchErrors(const std::function<int()>& run) {
  int code = static_cast<int>(ExitCode::kInternal);
  try {
    return run();
  } catch (const SetupError& error) {
    SayError(error.what());
    code = error.exit_code();
  } catch (const std::exception& error) {
    SayError(error.what());
  }
  return code;
}

void OpenClosedStreams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    // open() takes the lowest free number, which is this stream's.
    if (::fcntl(stream, F_GETFD) < 0) static_cast<void>(::open("/dev/null", O_RDWR));
  }
}

}  // namespace understudy
