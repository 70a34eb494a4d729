// Moves the camera, selects a body and drags it with the mouse, as MuJoCo's own viewer does.
#pragma once

#include <optional>

#include "viewer/camera_operator.h"
#include "viewer/stage.h"
#include "viewer/window.h"

namespace understudy::viewer {

// A body held at one of its points and dragged towards a point of the world.
struct Grip {
  int body = 0;
  Point at{};  // m, in the body's frame
  Point to{};  // m, world
};

class Pointer {
 public:
  // A double click selects, or lets go where nothing is; with the right button it turns the camera
  // to the point. Dragging turns (left), moves (right) and nears (middle) the camera, shift takes
  // the horizontal plane; with control held it moves the grip on the selected body in the plane of
  // the picture, with shift in the horizontal one. `aspect`: of the window, width to height.
  // `seconds`: of any steady clock. Returns whether the picture changed.
  bool Take(const WindowEvent& event, double aspect, double seconds, Stage* stage,
            CameraOperator* camera);

  // Set while a body is held.
  const std::optional<Grip>& grip() const { return grip_; }
  // The selection, as MuJoCo draws it.
  const mjvPerturb& selection() const { return selection_; }
  int selected() const { return selection_.select; }  // 0 for nothing

 private:
  void Click(const WindowEvent& event, double aspect, double seconds, Stage* stage,
             CameraOperator* camera);
  bool Drag(const WindowEvent& event, Stage* stage, CameraOperator* camera);
  void TakeHold(const Stage& stage);

  mjvPerturb selection_ = [] {
    mjvPerturb none;
    mjv_defaultPerturb(&none);
    return none;
  }();
  std::optional<Grip> grip_;
  int button_ = -1;  // that is down, GLFW's
  double x_ = 0, y_ = 0;
  int last_button_ = -1;
  double last_press_ = -1;  // s
};

}  // namespace understudy::viewer
