#include "motion/quadruped/gestures.h"

#include <array>
#include <initializer_list>
#include <utility>
#include <vector>

namespace understudy::motion {
namespace {

using Eigen::Vector3d;

constexpr double kReturnTime = 1.0;        // s back to the stand, assumed
constexpr std::size_t kKeyframesBack = 2;  // the last ones, which put the robot back on its feet

using Frames = std::vector<Keyframe>;

Keyframe Body(double duration, const Vector3d& place, const Vector3d& rpy) {
  return {.duration = duration, .pose = {.place = place, .rpy = rpy}};
}

// The weight off the front right paw, that paw from place to place, and down again. `way` has
// seconds and places of the paw.
Frames WithPaw(const Vector3d& body, const Vector3d& rpy,
               std::initializer_list<std::pair<double, Vector3d>> way) {
  const auto paw = [&](double duration, const Vector3d& place, double load) {
    return Keyframe{duration, {.place = body, .rpy = rpy, .paw = place, .paw_load = load}};
  };
  const Vector3d down(0, 0, 0);
  Frames frames{paw(1.2, down, 1), paw(0.4, down, 0)};
  for (const auto& [duration, place] : way) frames.push_back(paw(duration, place, 0));
  frames.push_back(paw(0.8, down, 0));
  frames.push_back(paw(0.4, down, 1));
  return frames;
}

// Shifts its weight back and waves the paw.
Frames Hello() {
  const Vector3d low(0.5, 0, 0.35), high(0.55, 0, 0.62);
  return WithPaw({-0.22, 0.13, -0.12}, {0, -0.4, 0},
                 {{0.6, high}, {0.3, low}, {0.3, high}, {0.3, low}, {0.3, high}});
}

// Chest down and back, then rump down.
Frames Stretch() {
  const Vector3d back(-0.15, 0, -0.25), ahead(0.1, 0, -0.2);
  return {Body(1.5, back, {0, 0.4, 0}), Body(1.0, back, {0, 0.4, 0}),
          Body(1.5, ahead, {0, -0.3, 0}), Body(0.7, ahead, {0, -0.3, 0})};
}

// Draws a heart into the air. A real one takes 7 s.
Frames Heart() {
  return WithPaw({-0.22, 0.13, -0.12}, {0, -0.4, 0},
                 {{0.7, {0.5, 0, 0.35}},
                  {0.4, {0.52, -0.12, 0.5}},
                  {0.4, {0.54, -0.08, 0.62}},
                  {0.4, {0.53, 0, 0.54}},
                  {0.4, {0.54, 0.08, 0.62}},
                  {0.4, {0.52, 0.12, 0.5}},
                  {0.5, {0.5, 0, 0.35}}});
}

// Bows and pulls the paw over the ground three times.
Frames Scrape() {
  const Vector3d far(0.35, 0, 0.12), near(0.1, 0, 0.12);
  return WithPaw({-0.22, 0.13, -0.15}, {0, -0.2, 0},
                 {{0.5, far}, {0.4, near}, {0.4, far}, {0.4, near}, {0.4, far}, {0.4, near}});
}

// Wags its rump, nose up.
Frames Content() {
  Frames frames;
  for (const double side : {1.0, -1.0, 1.0, -1.0, 1.0, -1.0}) {
    frames.push_back(Body(0.5, {0, 0.05 * side, -0.08}, {0, -0.12, 0.22 * side}));
  }
  return frames;
}

// Sways, bows, looks around and circles: 18 s, as a real one takes.
Frames Dance1() {
  Frames frames;
  for (const double side : {1.0, -1.0, 1.0, -1.0, 1.0, -1.0}) {
    frames.push_back(Body(0.8, {0, 0.08 * side, -0.06}, {0.18 * side, 0, 0}));
  }
  for (const double end : {1.0, -1.0, 1.0, -1.0}) {
    frames.push_back(Body(0.8, {-0.05 * end, 0, -0.12}, {0, 0.2 * end, 0}));
  }
  for (const double side : {1.0, -1.0, 1.0, -1.0, 1.0, -1.0}) {
    frames.push_back(Body(0.7, {0, 0, -0.05}, {0, -0.1, 0.28 * side}));
  }
  for (const Vector3d& rpy :
       {Vector3d(0.15, 0, 0), Vector3d(0.1, 0.1, 0), Vector3d(0, 0.15, 0), Vector3d(-0.1, 0.1, 0),
        Vector3d(-0.15, 0, 0), Vector3d(-0.1, -0.1, 0), Vector3d(0, -0.15, 0),
        Vector3d(0.1, -0.1, 0)}) {
    frames.push_back(Body(0.6, {0, 0, -0.08}, rpy));
  }
  return frames;
}

// Twists and dips: 8 s, as a real one takes.
Frames Dance2() {
  Frames frames;
  for (const double side : {1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0}) {
    frames.push_back(Body(0.7, {0, -0.05 * side, side > 0 ? -0.15 : -0.03},
                          {0.12 * side, 0.08 * side, 0.22 * side}));
  }
  return frames;
}

// Swings its rump from side to side over feet that stay.
Frames WiggleHips() {
  Frames frames;
  for (const double side : {1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0}) {
    frames.push_back(Body(0.4, {0, -0.06 * side, -0.05}, {0.08 * side, 0.1, 0.25 * side}));
  }
  return frames;
}

}  // namespace

std::span<const Keyframe> KeyframesOf(authority::goal::GestureName gesture) {
  // In the order of the enum.
  static const std::array kFrames{Hello(),  Stretch(), Content(), Dance1(),
                                  Dance2(), Scrape(),  Heart(),   WiggleHips()};
  return kFrames[static_cast<std::size_t>(gesture)];
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

void KeyframePlayer::Begin(std::span<const Keyframe> frames) {
  frames_ = frames;
  Play(0);
}

void KeyframePlayer::End() {
  if (frame_ + kKeyframesBack < frames_.size()) Play(frames_.size() - kKeyframesBack);
}

void KeyframePlayer::Play(std::size_t frame) {
  frame_ = frame;
  const Keyframe key = frame < frames_.size() ? frames_[frame] : Keyframe{kReturnTime, {}};
  stance_->MoveTo(stance_->Feasible(InMetres(key.pose, leg_length_, stand_height_)), key.duration);
}

void KeyframePlayer::Step(const QuadrupedReading& sensed, double dt, LegCommand* legs) {
  stance_->Step(sensed, dt, legs);
  if (stance_->over() && frame_ < frames_.size()) Play(frame_ + 1);
}

}  // namespace understudy::motion
