#include "physics/set_down.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <mujoco/mujoco.h>

#include "physics/geom_extent.h"

namespace understudy::physics {
namespace {

constexpr double kUpwards = 0.05;     // m per step in search of a free place
constexpr double kDownwards = 0.01;   // m, less than any foot is thick
constexpr double kHighest = 100;      // m
constexpr double kLowest = -20;       // m
constexpr double kResolution = 1e-6;  // m
constexpr double kSameGround = 1e-4;  // m within which ground counts as z = 0

class SetDown {
 public:
  SetDown(const mjModel& model, mjData* data, int base_body, int base_q)
      : model_(model),
        data_(data),
        robot_(model.body_rootid[base_body]),
        z_(data->qpos + base_q + 2),
        start_(*z_) {}
  ~SetDown() { *z_ = start_; }
  SetDown(const SetDown&) = delete;
  SetDown& operator=(const SetDown&) = delete;

  double Lift() {
    if ((model_.opt.disableflags & mjDSBL_CONTACT) != 0) return 0;
    mj_kinematics(&model_, data_);
    const double clearance = LowestPoint();
    if (!std::isfinite(clearance)) return 0;
    free_above_ = HighestGround() - clearance;
    double free = 0;
    while (Touches(free)) {
      free += kUpwards;
      if (free > kHighest) return 0;
    }
    double touching = free;
    while (!Touches(touching)) {
      free = touching;
      touching -= kDownwards;
      if (touching < kLowest) return 0;
    }
    if (EndsAt(-clearance, touching, free)) return 0;
    while (free - touching > kResolution) {
      const double middle = (free + touching) / 2;
      (Touches(middle) ? touching : free) = middle;
    }
    const double lift = free + clearance;
    return std::abs(lift) < kSameGround ? 0 : lift;
  }

 private:
  bool IsRobots(int geom) const { return model_.body_rootid[model_.geom_bodyid[geom]] == robot_; }
  bool IsGround(int geom) const { return model_.body_weldid[model_.geom_bodyid[geom]] == 0; }

  bool Touches(double lift) {
    if (lift > free_above_) return false;
    *z_ = start_ + lift;
    mj_kinematics(&model_, data_);
    mj_collision(&model_, data_);
    for (int i = 0; i < data_->ncon; ++i) {
      const mjContact& contact = data_->contact[i];
      if (contact.dist >= 0) continue;
      if ((IsRobots(contact.geom1) && IsGround(contact.geom2)) ||
          (IsGround(contact.geom1) && IsRobots(contact.geom2))) {
        return true;
      }
    }
    return false;
  }

  // Whether the robot begins to touch within kSameGround of `lift`, as on level ground, which two
  // looks between `touching` and `free` tell instead of a search.
  bool EndsAt(double lift, double touching, double free) {
    constexpr double kNear = kSameGround - 2 * kResolution;
    return touching < lift - kNear && lift + kNear < free && Touches(lift - kNear) &&
           !Touches(lift + kNear);
  }

  // Returns the lowest point of the robot's colliding geoms [m]; infinity if there are none.
  double LowestPoint() const {
    double lowest = std::numeric_limits<double>::infinity();
    for (int geom = 0; geom < static_cast<int>(model_.ngeom); ++geom) {
      if (Collides(model_, geom) && IsRobots(geom)) {
        lowest = std::min(lowest, physics::LowestPoint(model_, *data_, geom));
      }
    }
    return lowest;
  }

  // Returns a height [m] above which there is no ground; infinity if there is none.
  double HighestGround() const {
    double highest = -std::numeric_limits<double>::infinity();
    for (int geom = 0; geom < static_cast<int>(model_.ngeom); ++geom) {
      if (Collides(model_, geom) && IsGround(geom)) highest = std::max(highest, Top(geom));
    }
    return highest;
  }

  // MuJoCo 2 has no bounding sphere of planes and height fields.
  double Top(int geom) const {
    const int type = model_.geom_type[geom];
    const double origin = data_->geom_xpos[3 * geom + 2];
    if (type != mjGEOM_PLANE && type != mjGEOM_HFIELD) return origin + model_.geom_rbound[geom];
    if (data_->geom_xmat[9 * geom + 8] < 1) return std::numeric_limits<double>::infinity();
    if (type == mjGEOM_PLANE) return origin;
    return origin + model_.hfield_size[4 * model_.geom_dataid[geom] + 2];
  }

  const mjModel& model_;
  mjData* data_;
  int robot_;  // root body
  double free_above_ =
      std::numeric_limits<double>::infinity();  // lift [m] at which nothing touches
  mjtNum* z_;
  mjtNum start_;
};

}  // namespace

double LiftOntoGround(const mjModel& model, mjData* data, int base_body, int base_q) {
  return SetDown(model, data, base_body, base_q).Lift();
}

}  // namespace understudy::physics
