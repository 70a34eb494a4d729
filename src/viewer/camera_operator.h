// Points the camera: finds a first view and follows a body.
#pragma once

#include "viewer/stage.h"

namespace understudy::viewer {

class CameraOperator {
 public:
  // Looks as `choice` says at what the stage shows now, for a picture of that size. Throws
  // ModelError for a camera or body that the model has not.
  CameraOperator(const Stage& stage, const CameraChoice& choice, const PictureSize& size);

  // Moves along with what is followed, after Stage::Show(). `seconds`: since the last call, in the
  // time of whoever looks on; the camera is gently late.
  void Follow(const Stage& stage, double seconds);

  // Follows that body, or nothing (-1), from where the camera looks now.
  void Track(const Stage& stage, int body);
  int tracked() const { return tracked_; }

  mjvCamera* camera() { return &camera_; }

 private:
  mjvCamera camera_;
  int tracked_ = -1;
  Point offset_{};  // m, world: from the tracked body to where the camera looks
};

}  // namespace understudy::viewer
