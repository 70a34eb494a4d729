#include "viewer/pointer.h"

#include <algorithm>
#include <cmath>

#include <GLFW/glfw3.h>
#include <mujoco/mujoco.h>

namespace understudy::viewer {
namespace {

constexpr double kDoubleClick = 0.4;  // s between two presses; *assumed*
constexpr double kZoomStep = 0.05;    // of the distance per notch; MuJoCo's

struct Hit {
  int body = -1;
  Point at{};
};

Hit Select(const WindowEvent& event, double aspect, Stage* stage) {
  Hit hit;
  int geom = -1;
  int skin = -1;
  hit.body = mjv_select(&stage->model(), &stage->data(), &stage->option(), aspect, event.x / aspect,
                        1 - event.y, stage->scene(), hit.at.data(), &geom, &skin);
  return hit;
}

}  // namespace

bool Pointer::Take(const WindowEvent& event, double aspect, double seconds, Stage* stage,
                   CameraOperator* camera) {
  using Kind = WindowEvent::Kind;
  switch (event.kind) {
    case Kind::kButtonDown:
      Click(event, aspect, seconds, stage, camera);
      return true;
    case Kind::kButtonUp:
      if (event.code == button_) {
        button_ = -1;
        grip_.reset();
      }
      return true;
    case Kind::kMove: {
      const bool moved = button_ >= 0 && Drag(event, stage, camera);
      x_ = event.x;
      y_ = event.y;
      return moved;
    }
    case Kind::kScroll:
      mjv_moveCamera(&stage->model(), mjMOUSE_ZOOM, 0, kZoomStep * event.scroll, stage->scene(),
                     camera->camera());
      return true;
    default:
      return false;
  }
}

void Pointer::Click(const WindowEvent& event, double aspect, double seconds, Stage* stage,
                    CameraOperator* camera) {
  const bool twice = event.code == last_button_ && seconds - last_press_ < kDoubleClick;
  last_button_ = twice ? -1 : event.code;  // a third one begins anew
  last_press_ = seconds;
  button_ = event.code;
  x_ = event.x;
  y_ = event.y;
  if (twice) {
    const Hit hit = Select(event, aspect, stage);
    if (event.code == GLFW_MOUSE_BUTTON_LEFT) {
      selection_.select = std::max(hit.body, 0);
      if (hit.body > 0) {
        const Point at = stage->InBody(hit.body, hit.at);
        std::copy(at.begin(), at.end(), selection_.localpos);
      }
    } else if (event.code == GLFW_MOUSE_BUTTON_RIGHT && hit.body >= 0) {
      std::copy(hit.at.begin(), hit.at.end(), camera->camera()->lookat);
      camera->Track(*stage, event.control && hit.body > 0 ? hit.body : camera->tracked());
    }
  }
  if (event.control && selection_.select > 0 && !twice) TakeHold(*stage);
}

void Pointer::TakeHold(const Stage& stage) {
  Grip grip{.body = selection_.select, .at = {}, .to = {}};
  std::copy_n(selection_.localpos, 3, grip.at.begin());
  grip.to = stage.InWorld(grip.body, grip.at);
  grip_ = grip;
}

bool Pointer::Drag(const WindowEvent& event, Stage* stage, CameraOperator* camera) {
  const double dx = event.x - x_;
  const double dy = event.y - y_;
  const int move = event.shift ? mjMOUSE_MOVE_H : mjMOUSE_MOVE_V;
  if (grip_) {
    mjvPerturb hand = selection_;
    mjv_initPerturb(&stage->model(), &stage->data(), stage->scene(), &hand);
    hand.active = mjPERT_TRANSLATE;
    std::copy(grip_->to.begin(), grip_->to.end(), hand.refpos);
    mjv_movePerturb(&stage->model(), &stage->data(), move, dx, dy, stage->scene(), &hand);
    std::copy_n(hand.refpos, 3, grip_->to.begin());
    return true;
  }
  const int action = button_ == GLFW_MOUSE_BUTTON_RIGHT ? move
                     : button_ == GLFW_MOUSE_BUTTON_LEFT
                         ? (event.shift ? mjMOUSE_ROTATE_H : mjMOUSE_ROTATE_V)
                         : mjMOUSE_ZOOM;
  mjv_moveCamera(&stage->model(), action, dx, dy, stage->scene(), camera->camera());
  camera->Track(*stage, camera->tracked());
  return true;
}

}  // namespace understudy::viewer
