// OpenGL without a display.
#pragma once

#include <memory>
#include <string>

namespace understudy::viewer {

// A context that is current in the thread that made it, as long as it lives. It has no surface:
// MuJoCo draws into buffers of its own.
class HeadlessGl {
 public:
  virtual ~HeadlessGl() = default;
};

// By EGL (a graphics card, else Mesa's software), or by OSMesa (always software): `which` is "egl",
// "osmesa" or "" for the first of these that works. The libraries are loaded when asked for, one
// alone in a process: MuJoCo takes its functions from what is loaded.
// Throws SetupError, naming the Debian packages, when there is none.
std::unique_ptr<HeadlessGl> MakeHeadlessGl(const std::string& which);

}  // namespace understudy::viewer
