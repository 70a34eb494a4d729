// Moves the camera, selects bodies and drags them with the mouse, as MuJoCo's viewer does.
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
  // Processes an event. A double click selects a body, or none beside bodies; with the right button
  // it centres the camera on the point. Dragging rotates (left), moves (right) and zooms (middle)
  // the camera, with shift in the horizontal plane. With Ctrl, dragging moves the grip on the
  // selected body in the image plane, with shift in the horizontal one. `aspect` is width over
  // height of the window, `seconds` of any steady clock. Returns whether the picture changed.
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
  int button_ = -1;  // the pressed one, GLFW's
  double x_ = 0, y_ = 0;
  int last_button_ = -1;
  double last_press_ = -1;  // s
};

}  // namespace understudy::viewer
