// understudy-view: the program behind `understudy view`, `snapshot` and `film`.
#include <functional>

#include <CLI/CLI.hpp>

#include "base/catch_errors.h"
#include "base/exit_code.h"
#include "base/signals.h"
#include "viewer/arguments.h"
#include "viewer/camera_operator.h"
#include "viewer/canvas.h"
#include "viewer/film_command.h"
#include "viewer/headless_gl.h"
#include "viewer/live_robot.h"
#include "viewer/recording.h"
#include "viewer/viewer.h"

namespace understudy::viewer {
namespace {

void Draw(Stage* stage, const SceneState& state, const PictureArguments& picture) {
  const auto gl = MakeHeadlessGl(picture.gl);
  stage->Show(state);
  CameraOperator camera(*stage, picture.camera, picture.size);
  Canvas canvas(stage, picture.size, /*fine=*/true);
  stage->Compose(camera.camera(), picture.show, nullptr);
  WritePng(canvas.Draw(stage), picture.out);
}

void Snapshot(const SnapshotArguments& arguments) {
  const PictureArguments& picture = arguments.picture;
  CheckWritable(picture.out, picture.overwrite);
  if (!picture.recording.empty()) {
    const Recording recording(picture.recording);
    Stage stage(recording.ReadModel());
    Draw(&stage, recording.At(arguments.at, stage.positions()), picture);
    return;
  }
  const std::filesystem::path socket = client::ChosenSocket(picture.robot);
  Stage stage(FetchModel(socket));
  Draw(&stage, FetchState(socket, stage.positions()), picture);
}

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
    Viewer(client::ChosenSocket(view.robot), view).Run(should_stop);
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
