// Turns states that come at any times into pictures at even times.
#pragma once

#include <functional>
#include <optional>

#include "viewer/camera_operator.h"
#include "viewer/canvas.h"

namespace understudy::viewer {

// Returns the state `share` of the way from a to b: positions are interpolated, all else is a's.
// Returns a when the robot was reset in between.
SceneState Between(const mjModel& model, const SceneState& a, const SceneState& b, double share);

// Draws a picture for every 1 / fps seconds of film, whatever the rate of the states.
class FilmMaker {
 public:
  struct Plan {
    int fps = 30;
    double speed = 1;    // simulated seconds per second of film
    double orbit = 0;    // degrees per second of film
    double seconds = 0;  // of film; what comes after is not drawn
  };

  // `stage` must outlive this. `out` gets the pictures in order.
  FilmMaker(Stage* stage, const CameraChoice& camera, const ShowChoice& show,
            const PictureSize& size, const Plan& plan, std::function<void(const Image&)> out);

  // Takes the next state. The film begins at the first; a state that is not later than the one
  // before is ignored. Needs a current OpenGL context. False once the film is as long as planned.
  bool Add(const SceneState& state);

  double seconds() const { return pictures_ / static_cast<double>(plan_.fps); }  // of film so far

 private:
  void Draw(const SceneState& state);

  Stage* stage_;
  CameraChoice choice_;
  ShowChoice show_;
  PictureSize size_;
  Plan plan_;
  std::function<void(const Image&)> out_;
  std::optional<Canvas> canvas_;
  std::optional<CameraOperator> camera_;
  std::optional<SceneState> last_;
  double begin_ = 0;  // simulated s
  int pictures_ = 0;
};

}  // namespace understudy::viewer
