#include "physics/mujoco_world.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <mujoco/mujoco.h>

#include "mjcf/eigen_views.h"
#include "physics/geom_extent.h"

namespace understudy::physics {

using mjcf::Vector;

namespace {

// Warnings for which MuJoCo resets the state.
constexpr int kDivergenceWarnings[] = {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC};

}  // namespace

MujocoWorld::MujocoWorld(mjcf::ModelHandle model, const std::vector<PlacedRobot>& robots,
                         mjcf::ModelHandle nominal, mjcf::DataHandle memory)
    : model_(std::move(model)), nominal_(std::move(nominal)), data_(std::move(memory)) {
  if (data_ == nullptr) {
    data_ = mjcf::MakeData(*model_);
  } else {
    mjcf::ResetData(*model_, data_.get());
  }
  mj_kinematics(model_.get(), data_.get());
  robots_.reserve(robots.size());
  for (const PlacedRobot& robot : robots) {
    robots_.emplace_back(model_.get(), data_.get(), robot,
                         nominal_ == nullptr ? model_.get() : nominal_.get());
  }
  mj_forward(model_.get(), data_.get());
  for (RobotBody& robot : robots_) {
    robot.ReadMotion();
    robot.ReadAcceleration();
  }
  objects_ = FindLooseBodies(*model_, robots_);
  for (int geom = 0; geom < model_->ngeom; ++geom) {
    if (!IsGround(geom)) continue;
    const double friction = model_->geom_friction[3 * geom];
    const double before = nominal_ == nullptr ? friction : nominal_->geom_friction[3 * geom];
    ground_.push_back({.geom = geom,
                       .friction = friction,
                       .factor = before > 0 ? friction / before : 1,
                       .priority = model_->geom_priority[geom]});
  }
}

// What cannot move and is no robot's, such as the base of one that is bolted down.
bool MujocoWorld::IsGround(int geom) const {
  const int body = model_->geom_bodyid[geom];
  return model_->body_weldid[body] == 0 &&
         std::none_of(robots_.begin(), robots_.end(),
                      [body](const RobotBody& robot) { return robot.Has(body); });
}

// Of two geoms that touch MuJoCo uses the friction of that with the higher priority.
void MujocoWorld::SetGroundFriction(double friction) {
  for (const Ground& ground : ground_) {
    const bool own = friction == 0;
    model_->geom_friction[3 * ground.geom] = own ? ground.friction : friction * ground.factor;
    model_->geom_priority[ground.geom] = own ? ground.priority : 1;
  }
}

std::array<double, 2> MujocoWorld::GroundFriction() const {
  std::array<double, 2> range{std::numeric_limits<double>::infinity(), 0};
  for (const Ground& ground : ground_) {
    if (!Collides(*model_, ground.geom)) continue;
    const double friction = model_->geom_friction[3 * ground.geom];
    range = {std::min(range[0], friction), std::max(range[1], friction)};
  }
  return range;
}

void MujocoWorld::Walk(std::span<const objects::ObjectSpec> objects) {
  const std::vector<std::string> names = objects::NamesOf(objects);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (!objects::Walks(objects[i])) continue;
    const auto found = std::ranges::find(objects_, names[i], &LooseBody::name);
    found->walks = true;
    walkers_.push_back({.body = *found,
                        .walk = objects::Walk(objects[i]),
                        .z = model_->qpos0[found->q + 2],
                        .has_legs = objects::KindOf(objects[i]).gait.step > 0,
                        .weight = -model_->body_subtreemass[found->body] * model_->opt.gravity[2]});
  }
  if (!walkers_.empty()) Reset();
}

// Gives them pose and velocity, so that what they touch meets a surface that moves, and holds them
// up, so that none of it is drawn down with them.
void MujocoWorld::MoveWalkers() {
  const double t = static_cast<double>(walked_) * model_->opt.timestep;
  for (const Walker& walker : walkers_) {
    const objects::WalkPose at = walker.walk.At(t);
    const std::array<mjtNum, 7> pose{
        at.x, at.y, walker.z, std::cos(at.yaw / 2), 0, 0, std::sin(at.yaw / 2)};
    const std::array<mjtNum, 6> velocity{at.vx, at.vy, 0, 0, 0, at.turn};
    std::ranges::copy(pose, data_->qpos + walker.body.q);
    std::ranges::copy(velocity, data_->qvel + walker.body.v);
    data_->qfrc_applied[walker.body.v + 2] = walker.weight;
    if (!walker.has_legs) continue;
    const std::array<mjtNum, 2> legs{at.swing, -at.swing}, rates{at.swing_rate, -at.swing_rate};
    std::ranges::copy(legs, data_->qpos + walker.body.q + pose.size());
    std::ranges::copy(rates, data_->qvel + walker.body.v + velocity.size());
  }
}

void MujocoWorld::Reset() {
  mjcf::ResetData(*model_, data_.get());
  walked_ = 0;
  MoveWalkers();
  mj_forward(model_.get(), data_.get());
  for (RobotBody& robot : robots_) {
    robot.ReadMotion();
    robot.ReadAcceleration();
  }
}

void MujocoWorld::BeginStep() {
  mj_step1(model_.get(), data_.get());
  for (RobotBody& robot : robots_) robot.ReadMotion();
}

StepHealth MujocoWorld::EndStep() {
  mj_step2(model_.get(), data_.get());
  ++walked_;
  MoveWalkers();
  for (RobotBody& robot : robots_) robot.ReadAcceleration();
  mju_zero(data_->xfrc_applied, 6 * static_cast<int>(model_->nbody));
  StepHealth health = StepHealth::kFine;
  for (const int warning : kDivergenceWarnings) {
    if (data_->warning[warning].number != 0) health = StepHealth::kDiverged;
    data_->warning[warning].number = 0;
  }
  return health;
}

void MujocoWorld::AddForce(int body, const Eigen::Vector3d& p_WP, const Eigen::Vector3d& force_W) {
  const Eigen::Vector3d arm = p_WP - Vector(data_->xipos + 3 * body);
  const Eigen::Vector3d torque = arm.cross(force_W);
  mjtNum* wrench = data_->xfrc_applied + 6 * body;
  mju_addTo3(wrench, force_W.data());
  mju_addTo3(wrench + 3, torque.data());
}

const LooseBody* MujocoWorld::FindObject(std::string_view name) const {
  const auto found = std::ranges::find(objects_, name, &LooseBody::name);
  return found == objects_.end() ? nullptr : &*found;
}

const LooseBody* MujocoWorld::ObjectOf(int body) const {
  const auto found = std::ranges::find(objects_, model_->body_rootid[body], &LooseBody::body);
  return found == objects_.end() ? nullptr : &*found;
}

std::span<const double> MujocoWorld::ObjectPosition(const LooseBody& object) const {
  return {data_->qpos + object.q, 7};
}

std::span<const double> MujocoWorld::ObjectVelocity(const LooseBody& object) const {
  return {data_->qvel + object.v, 6};
}

void MujocoWorld::PlaceObject(const LooseBody& object, const Eigen::Vector3d& p_WP, double yaw) {
  Place(object, p_WP, yaw, *model_, data_.get());
}

int MujocoWorld::FindBody(const std::string& name) const {
  return mj_name2id(model_.get(), mjOBJ_BODY, name.c_str());
}

Eigen::Vector3d MujocoWorld::CenterOfMass(int body) const {
  return Vector(data_->xipos + 3 * body);
}

double MujocoWorld::SubtreeMass(int body) const { return model_->body_subtreemass[body]; }

PointReading MujocoWorld::Point(int body, const Eigen::Vector3d& p_BP) const {
  PointReading point;
  const mjcf::RotationView R_WB(data_->xmat + 9 * body);
  const Eigen::Vector3d offset = R_WB * p_BP;
  point.p_WP = Vector(data_->xpos + 3 * body) + offset;
  mjtNum velocity[6];  // angular, linear, at the body's origin, world axes
  mj_objectVelocity(model_.get(), data_.get(), mjOBJ_XBODY, body, velocity, 0);
  point.v_WP_W = Vector(velocity + 3) + Vector(velocity).cross(offset);
  return point;
}

double MujocoWorld::timestep() const { return model_->opt.timestep; }

}  // namespace understudy::physics
