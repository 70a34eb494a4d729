#include "viewer/robot_eyes.h"

#include <exception>
#include <utility>

#include <nlohmann/json.hpp>
#include <unistd.h>

#include "exec/socket_message.h"
#include "viewer/jpeg.h"
#include "viewer/live_robot.h"

namespace understudy::viewer {
namespace {

robot::CameraSpec ReadCamera(const nlohmann::json& order) {
  robot::CameraSpec camera;
  camera.name = order.at("camera");
  camera.width = order.at("width");
  camera.height = order.at("height");
  camera.focal = order.at("focal");
  camera.centre = order.at("centre");
  camera.distortion = order.at("distortion");
  camera.quality = order.at("quality");
  return camera;
}

}  // namespace

RobotEyes::RobotEyes(mjcf::ModelHandle model, const std::string& robot, const std::string& gl)
    : gl_(MakeHeadlessGl(gl)), stage_(std::move(model), robot) {}

RobotEyes::Eye::Eye(const robot::CameraSpec& spec, Stage* stage)
    : lens(spec), canvas(stage, lens.straight(), Canvas::Edges::kHard) {
  mjv_defaultCamera(&camera);
  camera.type = mjCAMERA_FIXED;
  camera.fixedcamid = stage->Camera(spec.name);
}

const Image& RobotEyes::See(const robot::CameraSpec& camera, double light,
                            const SceneState& state) {
  Eye& eye = eyes_.try_emplace(camera.name, camera, &stage_).first->second;
  stage_.Show(state);
  stage_.Compose(&eye.camera, {}, nullptr);
  return eye.lens.Bend(eye.canvas.Draw(&stage_), light);
}

void ServeCameras(const std::filesystem::path& control_socket) {
  std::optional<RobotEyes> eyes;
  while (const auto order = exec::ReceiveMessage(STDIN_FILENO)) {
    const auto snapshot = exec::ReceiveMessage(STDIN_FILENO);
    if (!snapshot) return;
    std::string reply;
    try {
      if (!eyes) eyes.emplace(FetchModel(control_socket), FetchName(control_socket));
      const nlohmann::json asked = nlohmann::json::parse(*order);
      const robot::CameraSpec camera = ReadCamera(asked);
      const SceneState state = ReadSnapshot(*snapshot, eyes->positions());
      reply = "+" + EncodeJpeg(eyes->See(camera, asked.at("light"), state), camera.quality);
    } catch (const std::exception& error) {
      reply = "-" + std::string(error.what());
    }
    if (!exec::SendMessage(STDIN_FILENO, reply)) return;
  }
}

}  // namespace understudy::viewer
