// Runs `understudy film`.
#pragma once

#include <functional>

#include "viewer/arguments.h"

namespace understudy::viewer {

// Makes the film; calls `should_stop` regularly. If it is stopped early, the file has the film so
// far. Throws SetupError: no robot, no OpenGL, no ffmpeg, a file that cannot be written.
void Film(const FilmArguments& arguments, const std::function<bool()>& should_stop);

}  // namespace understudy::viewer
