// Draws what a Stage has composed into a picture in memory.
#pragma once

#include "viewer/image.h"
#include "viewer/stage.h"

namespace understudy::viewer {

class Canvas {
 public:
  // Needs a current OpenGL context, also at its end. `fine` draws at twice the size and averages:
  // better edges, four times the work. Throws SetupError when the context cannot have such a
  // picture.
  Canvas(Stage* stage, const PictureSize& size, bool fine);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  // What the stage has composed last. The reference holds until the next call.
  const Image& Draw(Stage* stage);

 private:
  PictureSize drawn_;  // twice the picture where it is averaged
  bool fine_;
  mjrContext context_;
  Image image_, upside_down_;
};

}  // namespace understudy::viewer
