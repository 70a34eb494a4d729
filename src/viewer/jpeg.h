// Packs pictures as JPEG.
#pragma once

#include <string>

#include "viewer/canvas.h"

namespace understudy::viewer {

// Returns the bytes of a file; `quality` is 1 to 100. Colours have half of the resolution. Throws
// SetupError.
std::string EncodeJpeg(const Image& image, int quality);

}  // namespace understudy::viewer
