#include "viewer/film_maker.h"

#include <cmath>
#include <utility>

#include <mujoco/mujoco.h>

namespace understudy::viewer {
namespace {

constexpr double kLargestMove = 0.3;  // m that a base moves between two states at most; *assumed*

// The base's way between the two, 0 for a robot without a free joint.
double BaseWay(const mjModel& model, const SceneState& a, const SceneState& b) {
  for (int joint = 0; joint < model.njnt; ++joint) {
    if (model.jnt_type[joint] != mjJNT_FREE) continue;
    const auto at = static_cast<std::size_t>(model.jnt_qposadr[joint]);
    return std::hypot(b.qpos[at] - a.qpos[at], b.qpos[at + 1] - a.qpos[at + 1],
                      b.qpos[at + 2] - a.qpos[at + 2]);
  }
  return 0;
}

}  // namespace

SceneState Between(const mjModel& model, const SceneState& a, const SceneState& b, double share) {
  SceneState between = a;
  between.time = a.time + share * (b.time - a.time);
  if (share <= 0 || BaseWay(model, a, b) > kLargestMove) return between;
  std::vector<mjtNum> way(static_cast<std::size_t>(model.nv));
  mj_differentiatePos(&model, way.data(), 1, a.qpos.data(), b.qpos.data());
  mj_integratePos(&model, between.qpos.data(), way.data(), share);
  return between;
}

FilmMaker::FilmMaker(Stage* stage, const CameraChoice& camera, const ShowChoice& show,
                     const PictureSize& size, const Plan& plan,
                     std::function<void(const Image&)> out)
    : stage_(stage), choice_(camera), show_(show), size_(size), plan_(plan), out_(std::move(out)) {}

bool FilmMaker::Add(const SceneState& state) {
  if (!last_) {
    last_ = state;
    begin_ = state.time;
    stage_->Show(state);
    camera_.emplace(*stage_, choice_, size_);
    canvas_.emplace(stage_, size_, Canvas::Edges::kSmooth);
  }
  const auto due = [this] { return begin_ + pictures_ * (plan_.speed / plan_.fps); };
  // The picture that is due needs the states on both sides of it.
  while (due() <= state.time) {
    if (seconds() >= plan_.seconds) return false;
    const double way = state.time - last_->time;
    Draw(Between(stage_->model(), *last_, state, way > 0 ? (due() - last_->time) / way : 0));
    ++pictures_;
  }
  if (state.time > last_->time) last_ = state;
  return seconds() < plan_.seconds;
}

void FilmMaker::Draw(const SceneState& state) {
  stage_->Show(state);
  const double second = 1.0 / plan_.fps;
  camera_->Follow(*stage_, second);
  camera_->camera()->azimuth += plan_.orbit * second;
  stage_->Compose(camera_->camera(), show_, nullptr);
  if (plan_.plain) return out_(canvas_->Draw(stage_));
  const Caption caption = CaptionAt(state.time, kEventShown * plan_.speed, events_);
  out_(canvas_->Draw(stage_, &caption));
}

}  // namespace understudy::viewer
