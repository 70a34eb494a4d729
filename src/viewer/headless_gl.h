// Creates OpenGL contexts without a display.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace understudy::viewer {

// A context that is current in the creating thread while it exists. It has no surface: MuJoCo
// renders into framebuffers.
class HeadlessGl {
 public:
  virtual ~HeadlessGl() = default;
  // Whether Mesa draws on the processor, and no graphics card.
  virtual bool is_software() const = 0;
};

// Whether an OpenGL whose renderer has this name draws on the processor: Mesa's two that do.
bool IsSoftwareRenderer(std::string_view name);

// Uses EGL (a graphics card, else Mesa's software renderer) or OSMesa (always software): `which` is
// "egl", "osmesa" or "" for the first that works. Loads only one of the libraries per process,
// because MuJoCo takes its functions from the loaded one. Throws SetupError, with the Debian
// packages, if none works.
std::unique_ptr<HeadlessGl> MakeHeadlessGl(const std::string& which);

}  // namespace understudy::viewer
