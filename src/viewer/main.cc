// understudy-view: the program behind `understudy view`, `snapshot` and `film`.
#include <functional>

#include <CLI/CLI.hpp>

#include "base/catch_errors.h"
#include "base/exit_code.h"
#include "base/signals.h"
#include "viewer/arguments.h"
#include "viewer/commands.h"

namespace understudy::viewer {
namespace {

int Main(int argc, char** argv) {
  CLI::App app("What looks at a robot; started by `understudy view`, `snapshot` and `film`",
               "understudy");
  app.require_subcommand(1);
  ViewArguments view;
  SnapshotArguments snapshot;
  FilmArguments film;
  const auto should_stop = [] { return StopSignal() != 0; };
  AddViewCommand(&app, &view)->final_callback([&] {
    CatchStopSignals();
    View(view, should_stop);
  });
  AddSnapshotCommand(&app, &snapshot)->final_callback([&] { Snapshot(snapshot); });
  AddFilmCommand(&app, &film)->final_callback([&] {
    CatchStopSignals();
    Film(film, should_stop);
  });
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::kUsage);
  }
  return 0;
}

}  // namespace
}  // namespace understudy::viewer

int main(int argc, char** argv) {
  understudy::OpenClosedStreams();
  return understudy::CatchErrors([&] { return understudy::viewer::Main(argc, argv); });
}
