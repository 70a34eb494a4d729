// The program behind `understudy remote`.
#include <cstdio>

#include <CLI/CLI.hpp>

#include "base/catch_errors.h"
#include "base/exit_code.h"
#include "remote/arguments.h"
#include "remote/gamepads.h"
#include "remote/play_remote.h"

namespace understudy::remote {
namespace {

int Main(int argc, char** argv) {
  CLI::App app("", "understudy");
  app.require_subcommand(1);
  RemoteArguments arguments;
  AddRemoteCommand(&app, &arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::kUsage);
  }
  if (arguments.list_gamepads) {
    const Gamepads gamepads({.which = {}, .mapping_file = arguments.mapping});
    std::fputs(gamepads.List().c_str(), stdout);
    return 0;
  }
  PlayRemote(arguments);
  return 0;
}

}  // namespace
}  // namespace understudy::remote

int main(int argc, char** argv) {
  understudy::OpenClosedStreams();
  return understudy::CatchErrors([&] { return understudy::remote::Main(argc, argv); });
}
