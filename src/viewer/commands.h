// What `understudy view`, `snapshot` and `film` do, once their arguments are read.
#pragma once

#include <functional>

#include "viewer/arguments.h"

namespace understudy::viewer {

// Each returns when it is done; `should_stop` is asked again and again. They throw SetupErrors: no
// robot, no OpenGL, no ffmpeg, a file that cannot be written.
void View(const ViewArguments& arguments, const std::function<bool()>& should_stop);
void Snapshot(const SnapshotArguments& arguments);
// Stopped early, what was filmed is a whole file.
void Film(const FilmArguments& arguments, const std::function<bool()>& should_stop);

}  // namespace understudy::viewer
