#include "motion/quadruped/gestures.h"

#include <array>

namespace understudy::motion {
namespace {

using Eigen::Vector3d;

constexpr double kReturnTime = 1.0;        // s back to the stand, assumed
constexpr std::size_t kKeyframesBack = 2;  // the last ones, which put the robot back on its feet

Keyframe Body(double duration, const Vector3d& place, double pitch) {
  return {.duration = duration, .pose = {.place = place, .rpy = {0, pitch, 0}}};
}

Keyframe Paw(double duration, const Vector3d& place, const Vector3d& rpy, const Vector3d& paw,
             double load) {
  return {.duration = duration, .pose = {.place = place, .rpy = rpy, .paw = paw, .paw_load = load}};
}

}  // namespace

std::span<const Keyframe> HelloKeyframes() {
  static const std::array<Keyframe, 9> kFrames = [] {
    const Vector3d back(-0.22, 0.13, -0.12), up(0, -0.4, 0), down(0, 0, 0);
    const Vector3d low(0.5, 0, 0.35), high(0.55, 0, 0.62);
    return std::array{
        Paw(1.2, back, up, down, 1), Paw(0.4, back, up, down, 0), Paw(0.6, back, up, high, 0),
        Paw(0.3, back, up, low, 0),  Paw(0.3, back, up, high, 0), Paw(0.3, back, up, low, 0),
        Paw(0.3, back, up, high, 0), Paw(0.8, back, up, down, 0), Paw(0.4, back, up, down, 1)};
  }();
  return kFrames;
}

std::span<const Keyframe> StretchKeyframes() {
  static const std::array<Keyframe, 4> kFrames{
      Body(1.5, {-0.15, 0, -0.25}, 0.4), Body(1.0, {-0.15, 0, -0.25}, 0.4),
      Body(1.5, {0.1, 0, -0.2}, -0.3), Body(0.7, {0.1, 0, -0.2}, -0.3)};
  return kFrames;
}

const StancePose& PosePosture() {
  static const StancePose kPosture{.place = {0, 0, -0.1}, .rpy = {0, -0.2, 0}};
  return kPosture;
}

StancePose InMetres(const StancePose& posture, double leg_length, double stand_height) {
  StancePose pose = posture;
  pose.place *= leg_length;
  pose.place.z() += stand_height;
  pose.paw *= leg_length;
  return pose;
}

void Gesture::Begin(std::span<const Keyframe> frames) {
  frames_ = frames;
  Play(0);
}

void Gesture::End() {
  if (frame_ + kKeyframesBack < frames_.size()) Play(frames_.size() - kKeyframesBack);
}

void Gesture::Play(std::size_t frame) {
  frame_ = frame;
  const Keyframe key = frame < frames_.size() ? frames_[frame] : Keyframe{kReturnTime, {}};
  stance_->MoveTo(stance_->Feasible(InMetres(key.pose, leg_length_, stand_height_)), key.duration);
}

void Gesture::Step(const QuadrupedReading& sensed, double dt, LegCommand* legs) {
  stance_->Step(sensed, dt, legs);
  if (stance_->over() && frame_ < frames_.size()) Play(frame_ + 1);
}

}  // namespace understudy::motion
