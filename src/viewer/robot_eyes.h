// Draws what the cameras of a robot see: the program behind the pictures of its services.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "robot/robot_spec.h"
#include "viewer/canvas.h"
#include "viewer/h264_encoder.h"
#include "viewer/headless_gl.h"
#include "viewer/lens_table.h"
#include "viewer/scene_state.h"
#include "viewer/stage.h"

namespace understudy::viewer {

// OpenGL, model, and what is made for a camera once are kept between pictures.
class RobotEyes {
 public:
  // `gl` as for MakeHeadlessGl. `robot` as for Stage. Throws SetupError without OpenGL.
  RobotEyes(mjcf::ModelHandle model, const std::string& robot, const std::string& gl = "");

  // Returns the picture that a camera has in a state, with that share of its light and that noise,
  // of which robot::CameraEffects speaks; an instant has its own, always the same. The model has a
  // camera of its name. Throws SetupError.
  const Image& See(const robot::CameraSpec& camera, double light, const SceneState& state,
                   double noise = 0);

  // Returns the camera's last picture; null before the first.
  const Image* Last(const robot::CameraSpec& camera) const;

  // Returns a PNG of the depths of what the camera's last picture shows. Throws SetupError.
  std::string Depth(const robot::CameraSpec& camera);

  // Returns the frame of the camera's video that shows its picture. Throws SetupError.
  std::string Film(const robot::CameraSpec& camera, const Image& picture, double time);

  // Whether the sun casts shadows: drawn by the processor they take half of a picture's time, and
  // are left out.
  bool has_shadows() const { return !gl_->is_software(); }

  std::size_t positions() const { return stage_.positions(); }

 private:
  struct Eye {
    explicit Eye(const robot::CameraSpec& camera, Stage* stage);

    LensTable lens;
    Canvas canvas;
    std::vector<mjvCamera> views;        // one, or of the left eye and the right
    Image whole;                         // of two eyes, or with noise
    const Image* last = nullptr;         // of the lens, or the whole
    std::unique_ptr<H264Encoder> video;  // made for the first frame
  };

  std::unique_ptr<HeadlessGl> gl_;
  Stage stage_;
  std::map<std::string, Eye> eyes_;
};

// Serves `understudy run` on standard input, a socket, until that closes: for each order, and the
// snapshot that follows it, what it asks for behind a "+", or a reason behind a "-"
// (run/camera_process.h).
void ServeCameras(const std::filesystem::path& control_socket);

}  // namespace understudy::viewer
