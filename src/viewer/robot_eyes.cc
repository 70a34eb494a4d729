#include "viewer/robot_eyes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <exception>
#include <utility>

#include <nlohmann/json.hpp>
#include <unistd.h>

#include "exec/socket_message.h"
#include "sensors/chance.h"
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
  camera.depth = order.at("range");
  camera.baseline = order.at("baseline");
  camera.video_hz = order.at("video_hz");
  return camera;
}

// The same for the same instant and camera.
void AddNoise(double levels, double time, int camera, Image* picture) {
  constexpr double kMost = 255;
  sensors::Noise noise(static_cast<int>(std::llround(1000 * time)),
                       static_cast<std::uint64_t>(camera));
  for (std::uint8_t& colour : picture->rgb) {
    colour =
        static_cast<std::uint8_t>(std::lround(std::clamp(colour + levels * noise(), 0.0, kMost)));
  }
}

// The lengths of JPEG and depth in four bytes each, the JPEG, the depth, the frame; each is empty
// where it is not asked for.
std::string Answer(const nlohmann::json& order, const SceneState& state, RobotEyes* eyes) {
  const robot::CameraSpec camera = ReadCamera(order);
  const Image* picture = order.at("again") ? eyes->Last(camera) : nullptr;
  if (picture == nullptr) picture = &eyes->See(camera, order.at("light"), state, order.at("noise"));
  const std::string jpeg = order.at("jpeg") ? EncodeJpeg(*picture, camera.quality) : "";
  const std::string depth = order.at("depth") ? eyes->Depth(camera) : "";
  const std::array<std::uint32_t, 2> lengths{static_cast<std::uint32_t>(jpeg.size()),
                                             static_cast<std::uint32_t>(depth.size())};
  std::string answer(reinterpret_cast<const char*>(lengths.data()), sizeof lengths);
  answer += jpeg + depth;
  if (order.at("frame")) answer += eyes->Film(camera, *picture, state.time);
  return answer;
}

}  // namespace

RobotEyes::RobotEyes(mjcf::ModelHandle model, const std::string& robot, const std::string& gl)
    : gl_(MakeHeadlessGl(gl)), stage_(std::move(model), robot) {
  stage_.scene()->flags[mjRND_SHADOW] = has_shadows() ? 1 : 0;
}

RobotEyes::Eye::Eye(const robot::CameraSpec& spec, Stage* stage)
    : lens(spec), canvas(stage, lens.straight(), Canvas::Edges::kHard) {
  const auto look = [&](const std::string& name) {
    mjvCamera view;
    mjv_defaultCamera(&view);
    view.type = mjCAMERA_FIXED;
    view.fixedcamid = stage->Camera(name);
    views.push_back(view);
  };
  look(spec.name);
  if (robot::IsBinocular(spec)) look(robot::RightEyeName(spec));
}

const Image& RobotEyes::See(const robot::CameraSpec& camera, double light, const SceneState& state,
                            double noise) {
  Eye& eye = eyes_.try_emplace(camera.name, camera, &stage_).first->second;
  stage_.Show(state);
  const auto look = [&](mjvCamera* view) -> const Image& {
    stage_.Compose(view, {}, nullptr);
    return eye.lens.Bend(eye.canvas.Draw(&stage_), light);
  };
  eye.last = &look(&eye.views.front());
  if (eye.views.size() > 1) {
    const Image left = *eye.last;
    eye.whole = SideBySide(left, look(&eye.views.back()));
    eye.last = &eye.whole;
  }
  if (noise > 0) {
    if (eye.last != &eye.whole) eye.whole = *eye.last;
    AddNoise(noise, state.time, eye.views.front().fixedcamid, &eye.whole);
    eye.last = &eye.whole;
  }
  return *eye.last;
}

const Image* RobotEyes::Last(const robot::CameraSpec& camera) const {
  const auto eye = eyes_.find(camera.name);
  return eye == eyes_.end() ? nullptr : eye->second.last;
}

std::string RobotEyes::Depth(const robot::CameraSpec& camera) {
  Eye& eye = eyes_.at(camera.name);
  return EncodePng(eye.lens.BendDepths(eye.canvas.Depths(&stage_)));
}

std::string RobotEyes::Film(const robot::CameraSpec& camera, const Image& picture, double time) {
  auto& video = eyes_.at(camera.name).video;
  if (!video) {
    video = std::make_unique<H264Encoder>(
        PictureSize{.width = picture.width, .height = picture.height}, camera.video_hz);
  }
  return video->Encode(picture, time);
}

void ServeCameras(const std::filesystem::path& control_socket) {
  std::optional<RobotEyes> eyes;
  while (const auto order = exec::ReceiveMessage(STDIN_FILENO)) {
    const auto snapshot = exec::ReceiveMessage(STDIN_FILENO);
    if (!snapshot) return;
    std::string reply;
    try {
      if (!eyes) eyes.emplace(FetchModel(control_socket), FetchName(control_socket));
      const SceneState state = ReadSnapshot(*snapshot, eyes->positions());
      reply = "+" + Answer(nlohmann::json::parse(*order), state, &*eyes);
    } catch (const std::exception& error) {
      reply = "-" + std::string(error.what());
    }
    if (!exec::SendMessage(STDIN_FILENO, reply)) return;
  }
}

}  // namespace understudy::viewer
