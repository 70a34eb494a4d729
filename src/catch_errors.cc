#include "catch_errors.h"

#include <cstdio>
#include <exception>

#include <fcntl.h>
#include <unistd.h>

#include "control/control_error.h"
#include "exec/command.h"
#include "exit_code.h"
#include "robot/errors.h"

namespace understudy {
namespace {

int Fail(const std::exception& error, int code) {
  std::fprintf(stderr, "understudy: %s\n", error.what());
  return code;
}

int Fail(const std::exception& error, ExitCode code) { return Fail(error, static_cast<int>(code)); }

}  // namespace

int CatchErrors(const std::function<int()>& run) {
  try {
    return run();
  } catch (const ConfigError& error) {
    return Fail(error, ExitCode::kConfig);
  } catch (const ModelError& error) {
    return Fail(error, ExitCode::kModel);
  } catch (const BusError& error) {
    return Fail(error, ExitCode::kBus);
  } catch (const NeighbourError& error) {
    return Fail(error, ExitCode::kNeighbour);
  } catch (const SocketError& error) {
    return Fail(error, ExitCode::kSocket);
  } catch (const RecordError& error) {
    return Fail(error, ExitCode::kRecord);
  } catch (const CommandError& error) {
    return Fail(error, error.exit_code());
  } catch (const std::exception& error) {
    return Fail(error, ExitCode::kInternal);
  }
}

void OpenClosedStreams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    // The lowest free number is this stream's, as those below it are open by now.
    if (::fcntl(stream, F_GETFD) < 0) static_cast<void>(::open("/dev/null", O_RDWR));
  }
}

}  // namespace understudy
