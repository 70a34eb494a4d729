// understudy-view: the program behind `understudy view`, `picture` and `film`.
#include <functional>

#include <CLI/CLI.hpp>

#include "base/catch_errors.h"
#include "base/exit_code.h"
#include "base/files.h"
#include "base/signals.h"
#include "viewer/arguments.h"
#include "viewer/camera_operator.h"
#include "viewer/canvas.h"
#include "viewer/film_command.h"
#include "viewer/headless_gl.h"
#include "viewer/live_robot.h"
#include "viewer/recorded_states.h"
#include "viewer/robot_eyes.h"
#include "viewer/viewer.h"

namespace understudy::viewer {
namespace {

void Draw(Stage* stage, const SceneState& state, const DrawingArguments& drawing) {
  const auto gl = MakeHeadlessGl(drawing.gl);
  stage->Show(state);
  CameraOperator camera(*stage, drawing.camera, drawing.size);
  Canvas canvas(stage, drawing.size, Canvas::Edges::kFine);
  stage->Compose(camera.camera(), drawing.show, nullptr);
  WritePng(canvas.Draw(stage), drawing.out);
}

void DrawPicture(const PictureArguments& arguments) {
  const DrawingArguments& drawing = arguments.drawing;
  CheckWritable(drawing.out, drawing.overwrite);
  if (!drawing.recording.empty()) {
    const RecordedStates recording(drawing.recording);
    Stage stage(recording.ReadModel(), recording.robot());
    Draw(&stage, recording.At(arguments.at, stage.positions()), drawing);
    return;
  }
  const std::filesystem::path socket = client::ChosenSocket(drawing.robot);
  Stage stage(FetchModel(socket), FetchName(socket));
  Draw(&stage, FetchState(socket, stage.positions()), drawing);
}

int Main(int argc, char** argv) {
  CLI::App app("What looks at a robot; started by `understudy view`, `picture` and `film`",
               "understudy");
  app.require_subcommand(1);
  ViewArguments view;
  PictureArguments picture;
  FilmArguments film;
  const auto should_stop = [] { return StopSignal() != 0; };
  AddViewCommand(&app, &view)->final_callback([&] {
    CatchStopSignals();
    Viewer(client::ChosenSocket(view.robot), view).Run(should_stop);
  });
  AddPictureCommand(&app, &picture)->final_callback([&] { DrawPicture(picture); });
  AddFilmCommand(&app, &film)->final_callback([&] {
    CatchStopSignals();
    Film(film, should_stop);
  });
  std::string control_socket;
  CLI::App* const camera = app.add_subcommand("camera", "Draws for `understudy run`")->group("");
  camera->add_option("SOCKET", control_socket)->required();
  camera->final_callback([&] { ServeCameras(control_socket); });
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
