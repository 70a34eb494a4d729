#include "viewer/camera_operator.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <mujoco/mujoco.h>

namespace understudy::viewer {
namespace {

// *Assumed*: what looks good.
constexpr double kAzimuth = 135;    // degrees
constexpr double kUneven = 45;      // degrees, over ground that is not flat: it lies ahead
constexpr double kElevation = -18;  // degrees
constexpr double kCloseness = 1.1;  // of the distance from which the whole ball is seen
constexpr double kLateness = 0.15;  // s that the camera is behind what it follows
constexpr double kJump = 0.5;       // m; further is a reset, not a movement

// m, from which a ball of that radius just fills the picture.
double DistanceFor(double radius, double fovy, const PictureSize& size) {
  const double half = fovy / 2 * std::numbers::pi / 180;
  const double aspect = static_cast<double>(size.width) / size.height;
  const double narrow = std::min(half, std::atan(aspect * std::tan(half)));
  return radius / std::sin(narrow);
}

}  // namespace

CameraOperator::CameraOperator(const Stage& stage, const CameraChoice& choice,
                               const PictureSize& size)
    : size_(size) {
  mjv_defaultCamera(&camera_);
  if (choice.fixed()) {
    camera_.type = mjCAMERA_FIXED;
    camera_.fixedcamid = stage.Camera(choice.name);
    return;
  }
  const int body = choice.track.empty() ? stage.root() : stage.Body(choice.track);
  const Ball ball = stage.BodyBall(body);
  camera_.azimuth = choice.azimuth.value_or(stage.uneven() ? kUneven : kAzimuth);
  camera_.elevation = choice.elevation.value_or(kElevation);
  camera_.distance = choice.distance.value_or(
      kCloseness * DistanceFor(ball.radius, stage.model().vis.global.fovy, size));
  if (!choice.lookat.empty()) {
    std::copy_n(choice.lookat.begin(), 3, camera_.lookat);
    return;
  }
  std::copy(ball.center.begin(), ball.center.end(), camera_.lookat);
  Track(stage, body);
  if (!choice.distance) fitted_ = camera_.distance;
}

void CameraOperator::Track(const Stage& stage, int body) {
  tracked_ = body;
  fitted_ = -1;
  if (body < 0) return;
  for (std::size_t i = 0; i < 3; ++i) {
    offset_[i] = camera_.lookat[i] - stage.data().xpos[3 * static_cast<std::size_t>(body) + i];
  }
}

void CameraOperator::Follow(const Stage& stage, double seconds) {
  if (tracked_ < 0) return;
  const mjtNum* at = stage.data().xpos + 3 * static_cast<std::size_t>(tracked_);
  mjtNum wanted[3] = {}, way[3] = {};
  mju_add3(wanted, at, offset_.data());
  mju_sub3(way, wanted, camera_.lookat);
  const bool jumps = mju_norm3(way) > kJump;
  const double share = jumps ? 1 : 1 - std::exp(-std::max(seconds, 0.0) / kLateness);
  for (std::size_t i = 0; i < 3; ++i) camera_.lookat[i] += share * way[i];
  if (camera_.distance != fitted_) return;
  const Ball ball = stage.BodyBall(tracked_);
  const double least = DistanceFor(ball.radius + mju_dist3(ball.center.data(), wanted),
                                   stage.model().vis.global.fovy, size_);
  if (least > camera_.distance) camera_.distance += share * (least - camera_.distance);
  fitted_ = camera_.distance;
}

}  // namespace understudy::viewer
