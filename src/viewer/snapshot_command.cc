#include "viewer/camera_operator.h"
#include "viewer/canvas.h"
#include "viewer/commands.h"
#include "viewer/headless_gl.h"
#include "viewer/live_robot.h"
#include "viewer/recording.h"

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

}  // namespace

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

}  // namespace understudy::viewer
