#include "viewer/stage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include <mujoco/mujoco.h>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "physics/geom_extent.h"
#include "viewer/contact_shadows.h"

namespace understudy::viewer {
namespace {

constexpr int kVisibleGroups = 3;  // MuJoCo draws geoms of group 0, 1 and 2
constexpr int kCollisionGroup =
    3;                             // what models here, and most elsewhere, keep collision shapes in
constexpr int kDecorGeoms = 1000;  // arrows, discs, axes: *assumed*, far more than there ever are

constexpr float kContactColor[4] = {0.95F, 0.55F, 0.1F, 1};
constexpr float kPushColor[4] = {0.85F, 0.1F, 0.25F, 1};
constexpr float kRopeColor[4] = {0.25F, 0.25F, 0.27F, 1};
constexpr float kComColor[4] = {0.95F, 0.8F, 0.1F, 1};

// The next free geom of the scene with these looks; null when it is full.
mjvGeom* NewGeom(mjvScene* scene, int type, const mjtNum size[3], const float rgba[4]) {
  if (scene->ngeom >= scene->maxgeom) return nullptr;
  mjvGeom* geom = scene->geoms + scene->ngeom++;
  mjv_initGeom(geom, type, size, nullptr, nullptr, rgba);
  geom->category = mjCAT_DECOR;
  return geom;
}

void AddBall(mjvScene* scene, const Point& at, double radius, const float rgba[4]) {
  const mjtNum size[3] = {radius, radius, radius};
  if (mjvGeom* geom = NewGeom(scene, mjGEOM_SPHERE, size, rgba)) {
    for (int i = 0; i < 3; ++i) geom->pos[i] = static_cast<float>(at[static_cast<std::size_t>(i)]);
  }
}

void AddConnector(mjvScene* scene, int type, double width, const Point& from, const Point& to,
                  const float rgba[4]) {
  mjvGeom* geom = NewGeom(scene, type, nullptr, rgba);
  if (geom == nullptr) return;
  mjv_makeConnector(geom, type, width, from[0], from[1], from[2], to[0], to[1], to[2]);
}

// Stands between the name of one of several robots and the names of its bodies.
constexpr char kOfRobot = '/';

std::string_view NameOf(const mjModel& model, int body) {
  const char* name = mj_id2name(&model, mjOBJ_BODY, body);
  return name == nullptr ? std::string_view() : name;
}

double Length(const Point& p) { return std::hypot(p[0], p[1], p[2]); }

int FindByName(const mjModel& model, mjtObj type, int count, const char* what,
               const std::string& prefix, const std::string& name) {
  for (const std::string& known : {name, prefix + name}) {
    if (const int id = mj_name2id(&model, type, known.c_str()); id >= 0) return id;
  }
  std::vector<std::string> names;
  for (int i = 0; i < count; ++i) {
    if (const char* known = mj_id2name(&model, type, i)) names.emplace_back(known);
  }
  throw ModelError(std::string("the model has no ") + what + " '" + name + "'" +
                   (names.empty() ? " and no other" : DidYouMean(name, names)));
}

}  // namespace

Stage::Stage(mjcf::ModelHandle model, const std::string& robot)
    : model_(std::move(model)), prefix_(robot + kOfRobot), data_(mj_makeData(model_.get())) {
  mjv_defaultScene(&scene_);
  mjv_defaultOption(&option_);
  mjv_makeScene(model_.get(), &scene_, 2 * model_->ngeom + kDecorGeoms);
  // Without reflections: a floor would show highlights of objects as streaks.
  scene_.flags[mjRND_REFLECTION] = 0;
  // The root of the first body that can move; of several robots the named one's.
  for (int body = 1; body < model_->nbody; ++body) {
    if (model_->body_weldid[body] == 0) continue;
    const bool own = NameOf(*model_, body).starts_with(prefix_);
    if (own || root_ == 0) root_ = model_->body_rootid[body];
    if (own) break;
  }
  only_collision_ = true;
  for (int geom = 0; geom < model_->ngeom; ++geom) {
    if (Moves(geom) && model_->geom_group[geom] < kVisibleGroups) only_collision_ = false;
  }
  state_.qpos.assign(model_->qpos0, model_->qpos0 + model_->nq);
  Show(SceneState(state_));
  size_ = RobotBall().radius;
}

Stage::~Stage() { mjv_freeScene(&scene_); }

void Stage::Show(const SceneState& state) {
  state_ = state;
  for (std::size_t i = 0; i < state_.qpos.size(); ++i) {
    if (std::isfinite(state_.qpos[i])) data_->qpos[i] = state_.qpos[i];
  }
  data_->time = state_.time;
  mj_kinematics(model_.get(), data_.get());
  mj_comPos(model_.get(), data_.get());
  mj_camlight(model_.get(), data_.get());
  mj_tendon(model_.get(), data_.get());
}

bool Stage::Moves(int geom) const { return model_->body_weldid[model_->geom_bodyid[geom]] != 0; }

bool Stage::Below(int body, int ancestor) const {
  while (body > ancestor) body = model_->body_parentid[body];
  return body == ancestor;
}

bool Stage::OfRobots(int geom) const {
  const int body = model_->geom_bodyid[geom];
  return Below(body, root_) || NameOf(*model_, body).find(kOfRobot) != std::string_view::npos;
}

bool Stage::uneven() const {
  for (int geom = 0; geom < model_->ngeom; ++geom) {
    if (!OfRobots(geom) && model_->geom_type[geom] != mjGEOM_PLANE) return true;
  }
  return false;
}

Ball Stage::RobotBall() const { return BodyBall(root_); }

Ball Stage::BodyBall(int body) const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Point low{kFar, kFar, kFar};
  Point high{-kFar, -kFar, -kFar};
  for (int geom = 0; geom < model_->ngeom; ++geom) {
    if (!Below(model_->geom_bodyid[geom], body)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const mjtNum* row = data_->geom_xmat + 9 * geom + 3 * axis;  // the world's axis, in its frame
      const mjtNum back[3] = {-row[0], -row[1], -row[2]};
      const double at = data_->geom_xpos[3 * static_cast<std::size_t>(geom) + axis];
      low[axis] = std::min(low[axis], at - physics::Reach(*model_, geom, back));
      high[axis] = std::max(high[axis], at + physics::Reach(*model_, geom, row));
    }
  }
  Ball ball;
  if (low[0] > high[0]) {  // no shapes
    for (std::size_t i = 0; i < 3; ++i) {
      ball.center[i] = data_->xpos[3 * static_cast<std::size_t>(body) + i];
    }
    ball.radius = std::max(model_->stat.extent / 2, 0.1);
    return ball;
  }
  Point half{};
  for (std::size_t i = 0; i < 3; ++i) {
    ball.center[i] = (low[i] + high[i]) / 2;
    half[i] = (high[i] - low[i]) / 2;
  }
  ball.radius = std::max(Length(half), 1e-3);
  return ball;
}

Point Stage::InWorld(int body, const Point& p) const {
  Point world{};
  const auto i = static_cast<std::size_t>(body);
  mju_mulMatVec(world.data(), data_->xmat + 9 * i, p.data(), 3, 3);
  mju_addTo3(world.data(), data_->xpos + 3 * i);
  return world;
}

Point Stage::InBody(int body, const Point& p) const {
  Point from_origin{};
  Point local{};
  const auto i = static_cast<std::size_t>(body);
  mju_sub3(from_origin.data(), p.data(), data_->xpos + 3 * i);
  mju_mulMatTVec(local.data(), data_->xmat + 9 * i, from_origin.data(), 3, 3);
  return local;
}

int Stage::Body(const std::string& name) const {
  return FindByName(*model_, mjOBJ_BODY, model_->nbody, "body", prefix_, name);
}

int Stage::Camera(const std::string& name) const {
  return FindByName(*model_, mjOBJ_CAMERA, model_->ncam, "camera", prefix_, name);
}

void Stage::Choose(const ShowChoice& show) {
  const bool collision = show.collision || only_collision_;
  for (int group = 0; group < mjNGROUP; ++group) {
    const bool bare = show.collision && group == 2;  // the usual group of visual geoms
    option_.geomgroup[group] =
        group < kVisibleGroups ? !bare : group == kCollisionGroup && collision;
  }
  option_.flags[mjVIS_JOINT] = show.joints;
  option_.flags[mjVIS_TRANSPARENT] = show.com || show.joints;  // else they are out of sight
}

void Stage::AddForce(const SceneState::Force& force, const float rgba[4]) {
  // A force of the robot's weight is drawn with the robot's size; larger ones are not drawn longer.
  const double weight = model_->body_subtreemass[root_] * 9.81;
  const double size = Length(force.force);
  if (!(size > 0.002 * weight) || !std::isfinite(size)) return;
  const double scale = 2 * size_ / std::max(weight, size);
  Point tip{};
  for (std::size_t i = 0; i < 3; ++i) tip[i] = force.at[i] + scale * force.force[i];
  AddConnector(&scene_, mjGEOM_ARROW, 0.02 * size_, force.at, tip, rgba);
}

void Stage::AddDecor(const ShowChoice& show) {
  if (show.contacts) {
    for (const SceneState::Force& contact : state_.contacts) {
      AddBall(&scene_, contact.at, 0.03 * size_, kContactColor);
    }
  }
  if (show.forces) {
    for (const SceneState::Force& contact : state_.contacts) AddForce(contact, kContactColor);
  }
  // Forces by the user are always visible.
  for (const SceneState::Force& push : state_.pushes) AddForce(push, kPushColor);
  if (state_.crane) {
    const double rope = 0.01 * size_;
    AddConnector(&scene_, mjGEOM_CAPSULE, rope, state_.crane->top, state_.crane->hook, kRopeColor);
    AddBall(&scene_, state_.crane->hook, 3 * rope, kRopeColor);
    AddBall(&scene_, state_.crane->top, 3 * rope, kRopeColor);
  }
  if (show.com) {
    Point com{};
    std::copy_n(data_->subtree_com + 3 * root_, 3, com.begin());
    Point foot = com;
    foot[2] = 0;
    AddBall(&scene_, com, 0.08 * size_, kComColor);
    AddConnector(&scene_, mjGEOM_CAPSULE, 0.008 * size_, com, foot, kComColor);
  }
}

// MuJoCo shows a free joint as a cube as large as a trunk.
void Stage::HideFreeJoints() {
  const auto* end =
      std::remove_if(scene_.geoms, scene_.geoms + scene_.ngeom, [&](const mjvGeom& geom) {
        return geom.objtype == mjOBJ_JOINT && model_->jnt_type[geom.objid] == mjJNT_FREE;
      });
  scene_.ngeom = static_cast<int>(end - scene_.geoms);
}

// A model's sun stands where its file has it, and its shadow map reaches as far as the whole scene
// does. It is to follow the camera, and to be as fine as what that sees allows.
void Stage::MoveSun(const mjvCamera& camera) {
  const bool free = camera.type == mjCAMERA_FREE;
  const double most = model_->stat.extent * model_->vis.map.shadowclip;
  shadow_reach_ =
      free ? std::min(std::max(2 * size_, 1.2 * camera.distance), std::max(most, 2 * size_)) : most;
  if (!free) return;
  for (int i = 0; i < scene_.nlight; ++i) {
    mjvLight& light = scene_.lights[i];
    if (light.directional == 0 || light.headlight != 0) continue;
    for (int axis = 0; axis < 3; ++axis) {
      light.pos[axis] =
          static_cast<float>(camera.lookat[axis] - 2 * shadow_reach_ * light.dir[axis]);
    }
  }
}

void Stage::AddLine(const Point& from, const Point& to, const float rgba[4]) {
  AddConnector(&scene_, mjGEOM_CAPSULE, 0.01 * size_, from, to, rgba);
  AddBall(&scene_, to, 0.03 * size_, rgba);
}

void Stage::Compose(mjvCamera* camera, const ShowChoice& show, const mjvPerturb* perturb) {
  Choose(show);
  mjv_updateScene(model_.get(), data_.get(), &option_, perturb, camera, mjCAT_ALL, &scene_);
  HideFreeJoints();
  AddDecor(show);
  AddContactShadows(
      *model_, *data_, [this](int geom) { return OfRobots(geom); }, &scene_);
  MoveSun(*camera);
}

}  // namespace understudy::viewer
