// Runs `understudy film`.
#pragma once

#include <functional>

#include "viewer/arguments.h"

namespace understudy::viewer {

// Returns when it is done; `should_stop` is asked again and again. Stopped early, what was filmed
// is a whole file. Throws SetupErrors: no robot, no OpenGL, no ffmpeg, a file that cannot be
// written.
void Film(const FilmArguments& arguments, const std::function<bool()>& should_stop);

}  // namespace understudy::viewer
