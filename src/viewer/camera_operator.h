// Points the camera: finds a first view and follows a body.
#pragma once

#include "viewer/stage.h"

namespace understudy::viewer {

class CameraOperator {
 public:
  // Sets up the camera of `choice` for the present scene and a picture of that size. Throws
  // ModelError for a camera or body that the model does not have.
  CameraOperator(const Stage& stage, const CameraChoice& choice, const PictureSize& size);

  // Follows the tracked body, smoothed, and steps back where that leaves the picture, until
  // somebody chooses a distance. Call it after Stage::Show(). `seconds` is the viewer's time since
  // the last call.
  void Follow(const Stage& stage, double seconds);

  // Tracks that body, or none (-1), from the present view.
  void Track(const Stage& stage, int body);
  int tracked() const { return tracked_; }

  mjvCamera* camera() { return &camera_; }

 private:
  mjvCamera camera_;
  int tracked_ = -1;
  Point offset_{};  // m, world: from the tracked body to the look-at point
  PictureSize size_;
  double fitted_ = -1;  // m, the distance of our own choice; -1 where somebody else has chosen
};

}  // namespace understudy::viewer
