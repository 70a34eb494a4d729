#include "motion/quadruped_gestures.h"

#include <array>

namespace understudy {
namespace {

using Eigen::Vector3d;

Keyframe Body(double duration, Vector3d place, double pitch) {
  return {.duration = duration, .pose = {.place = place, .rpy = {0, pitch, 0}}};
}

Keyframe Paw(double duration, Vector3d place, Vector3d rpy, Vector3d paw, double load) {
  return {.duration = duration,
          .pose = {.place = place, .rpy = rpy, .paw = paw, .paw_load = load}};
}

}  // namespace

std::span<const Keyframe> HelloKeyframes() {
  static const std::array<Keyframe, 9> kFrames = [] {
    const Vector3d back(-0.2, 0.12, -0.15), tilt(0, -0.25, 0);
    const Vector3d low(0.3, 0, 0.55), high(0.35, 0, 0.85);
    return std::array{Paw(1.0, back, tilt, {0, 0, 0}, 1),
                      Paw(0.4, back, tilt, {0, 0, 0}, 0),
                      Paw(0.6, back, tilt, low, 0),
                      Paw(0.3, back, tilt, high, 0),
                      Paw(0.3, back, tilt, low, 0),
                      Paw(0.3, back, tilt, high, 0),
                      Paw(0.3, back, tilt, low, 0),
                      Paw(0.8, back, tilt, {0, 0, 0.0}, 0),
                      Paw(0.4, back, tilt, {0, 0, 0}, 1)};
  }();
  return kFrames;
}

std::span<const Keyframe> StretchKeyframes() {
  static const std::array<Keyframe, 4> kFrames{
      Body(1.5, {-0.2, 0, -0.3}, 0.45), Body(1.0, {-0.2, 0, -0.3}, 0.45),
      Body(1.5, {0.15, 0, -0.25}, -0.35), Body(0.7, {0.15, 0, -0.25}, -0.35)};
  return kFrames;
}

const StancePose& PosePosture() {
  static const StancePose kPosture{.place = {0, 0, -0.1}, .rpy = {0, -0.2, 0}};
  return kPosture;
}

}  // namespace understudy
