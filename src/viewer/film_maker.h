// Resamples states at arbitrary times to pictures at a constant rate.
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "viewer/camera_operator.h"
#include "viewer/canvas.h"

namespace understudy::viewer {

// Interpolates positions at the fraction `share` between a and b; all else is a's. Returns a if the
// robot was reset in between.
SceneState Between(const mjModel& model, const SceneState& a, const SceneState& b, double share);

// How long an event stands in a film [s of film]; *assumed*: to be read.
inline constexpr double kEventShown = 4;

// Draws a picture for every 1 / fps seconds of film, at any rate of the states.
class FilmMaker {
 public:
  struct Plan {
    int fps = 30;
    double speed = 1;    // simulated seconds per second of film
    double orbit = 0;    // degrees per second of film
    double seconds = 0;  // of film; later states are not drawn
    bool plain = false;  // without clock and events
  };

  // `stage` must outlive it. `out` gets the pictures in order.
  FilmMaker(Stage* stage, const CameraChoice& camera, const ShowChoice& show,
            const PictureSize& size, const Plan& plan, std::function<void(const Image&)> out);

  // Takes the next state. The film begins at the first; a state that is not later than the previous
  // one is ignored. Needs a current OpenGL context. Returns false when the film has its planned
  // length.
  bool Add(const SceneState& state);

  // An event, for pictures of its time and the kEventShown s of film after it. Call it in order of
  // time, before the states that follow the event.
  void Tell(FilmEvent event) { events_.push_back(std::move(event)); }

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
  std::vector<FilmEvent> events_;
  double begin_ = 0;  // simulated s
  int pictures_ = 0;
};

}  // namespace understudy::viewer
