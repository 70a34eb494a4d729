#include "base/catch_errors.h"

#include <cstdio>
#include <exception>

#include <fcntl.h>
#include <unistd.h>

#include "base/errors.h"

namespace understudy {
int CatchErrors(const std::function<int()>& run) {
  int code = static_cast<int>(ExitCode::kInternal);
  try {
    return run();
  } catch (const SetupError& error) {
    std::fprintf(stderr, "understudy: %s\n", error.what());
    code = error.exit_code();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "understudy: %s\n", error.what());
  }
  return code;
}

void OpenClosedStreams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    // The lowest free number is this stream's, as those below it are open by now.
    if (::fcntl(stream, F_GETFD) < 0) static_cast<void>(::open("/dev/null", O_RDWR));
  }
}

}  // namespace understudy
