#include "objects/walk.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace understudy::objects {
namespace {

// The corners in the order of its way, with `pos` first. After the last it goes to the first,
// unless it stays.
std::vector<Corner> CornersOf(const ObjectSpec& object) {
  std::vector<Corner> corners{{.to = {object.pos[0], object.pos[1]}, .wait = object.wait}};
  corners.insert(corners.end(), object.path.begin(), object.path.end());
  if (object.then == PathEnd::kBack) {
    for (std::size_t i = object.path.size() - 1; i > 0; --i) corners.push_back(corners[i]);
  }
  return corners;
}

double YawOf(const Corner& from, const Corner& to) {
  return std::atan2(to.to[1] - from.to[1], to.to[0] - from.to[0]);
}

// From 0 to 1; the values of this generator are the same everywhere.
double DrawnPart(int seed) {
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

}  // namespace

Walk::Walk(const ObjectSpec& object)
    : gait_(KindOf(object).gait), stays_(object.then == PathEnd::kStay) {
  const std::vector<Corner> corners = CornersOf(object);
  const double speed = SpeedOf(object);
  const auto add = [this](double seconds, const WalkPose& start) {
    stretches_.push_back({.from = period_, .start = start});
    period_ += seconds;
  };
  const std::size_t legs = stays_ ? corners.size() - 1 : corners.size();
  for (std::size_t i = 0; i < legs; ++i) {
    const Corner& from = corners[i];
    const Corner& to = corners[(i + 1) % corners.size()];
    const double dx = to.to[0] - from.to[0], dy = to.to[1] - from.to[1];
    const double yaw = YawOf(from, to), length = std::hypot(dx, dy);
    WalkPose pose{.x = from.to[0], .y = from.to[1], .yaw = yaw};
    add(from.wait, pose);
    pose.vx = speed * dx / length;
    pose.vy = speed * dy / length;
    add(length / speed, pose);
    stretches_.back().length = length;
    pose = {.x = to.to[0], .y = to.to[1], .yaw = yaw};
    if (i + 1 < legs || !stays_) {
      const Corner& next = corners[(i + 2) % corners.size()];
      const double angle = std::remainder(YawOf(to, next) - yaw, 2 * std::numbers::pi);
      pose.turn = std::copysign(kTurnRate, angle);
      add(std::abs(angle) / kTurnRate, pose);
    } else {
      stretches_.push_back({.from = period_, .start = pose});
    }
  }
  if (object.seed > 0) begins_ = period_ * DrawnPart(object.seed);
}

WalkPose Walk::At(double t) const {
  double at = begins_ + t;
  if (!stays_) at = std::fmod(at, period_);
  const auto after = std::ranges::upper_bound(stretches_, at, {}, &Stretch::from);
  const Stretch& stretch = after == stretches_.begin() ? *after : *(after - 1);
  const double since = at - stretch.from;
  WalkPose pose = stretch.start;
  pose.x += pose.vx * since;
  pose.y += pose.vy * since;
  pose.yaw += pose.turn * since;
  if (gait_.step > 0 && stretch.length > 0) {
    Swing(std::hypot(pose.vx, pose.vy) * since, stretch, &pose);
  }
  return pose;
}

// In the first and the last step of a stretch the legs come to swing and to rest smoothly.
void Walk::Swing(double walked, const Stretch& stretch, WalkPose* pose) const {
  const double speed = std::hypot(pose->vx, pose->vy), left = stretch.length - walked;
  double part = 1, part_rate = 0;
  if (const double nearest = std::min(walked, left); nearest < gait_.step) {
    const double angle = std::numbers::pi * nearest / gait_.step;
    part = (1 - std::cos(angle)) / 2;
    part_rate =
        (walked < left ? speed : -speed) * std::numbers::pi / gait_.step * std::sin(angle) / 2;
  }
  const double most = std::atan2(gait_.step / 2, gait_.hips);
  const double phase = std::numbers::pi * walked / gait_.step,
               phase_rate = std::numbers::pi * speed / gait_.step;
  pose->swing = most * part * std::sin(phase);
  pose->swing_rate = most * (part_rate * std::sin(phase) + part * phase_rate * std::cos(phase));
}

}  // namespace understudy::objects
