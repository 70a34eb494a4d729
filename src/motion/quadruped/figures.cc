#include "motion/quadruped/figures.h"

#include <algorithm>
#include <limits>
#include <span>
#include <string>

#include <mujoco/mujoco.h>

#include "base/errors.h"
#include "mjcf/eigen_views.h"
#include "physics/feet.h"
#include "physics/geom_extent.h"

namespace understudy::motion {

using mjcf::Quaternion;
using mjcf::Vector;

namespace {

constexpr std::size_t kLegs = 4;
constexpr std::size_t kLegMotors = 12;

// A point of a body, or of one that hangs on it, in the frame of `ancestor` with all joints at
// zero.
Eigen::Vector3d InAncestor(const mjModel& model, int body, int ancestor, Eigen::Vector3d point) {
  for (; body != ancestor; body = model.body_parentid[body]) {
    point = Vector(model.body_pos + 3 * body) + Quaternion(model.body_quat + 4 * body) * point;
  }
  return point;
}

// Returns a rotation in the ancestor's frame.
Eigen::Quaterniond TurnInAncestor(const mjModel& model, int body, int ancestor,
                                  Eigen::Quaterniond turn) {
  for (; body != ancestor; body = model.body_parentid[body]) {
    turn = Quaternion(model.body_quat + 4 * body) * turn;
  }
  return turn;
}

bool HangsOn(const mjModel& model, int body, int ancestor) {
  while (body != 0 && body != ancestor) body = model.body_parentid[body];
  return body == ancestor;
}

// All bodies that hang on `root`, but not through one of `without`, as one lump.
template <class Without>
LinkMass Lump(const mjModel& model, int root, const Without& without) {
  LinkMass lump;
  Eigen::Vector3d moment(0, 0, 0);
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // about the root's origin
  for (int body = root; body < model.nbody; ++body) {
    if (!HangsOn(model, body, root)) continue;
    if (std::any_of(without.begin(), without.end(),
                    [&](int other) { return HangsOn(model, body, other); })) {
      continue;
    }
    const double mass = model.body_mass[body];
    const Eigen::Vector3d com = InAncestor(model, body, root, Vector(model.body_ipos + 3 * body));
    const Eigen::Matrix3d R =
        TurnInAncestor(model, body, root, Quaternion(model.body_iquat + 4 * body))
            .toRotationMatrix();
    inertia += R * Vector(model.body_inertia + 3 * body).asDiagonal() * R.transpose() +
               PointInertia(mass, com);
    moment += mass * com;
    lump.mass += mass;
  }
  if (lump.mass > 0) lump.com = moment / lump.mass;
  lump.inertia = inertia - PointInertia(lump.mass, lump.com);
  return lump;
}

// A shape with its half sizes along its own axes, less what is round about it.
struct Half {
  Eigen::Vector3d size;
  double rounding;
};

Half HalfOf(const mjModel& model, int geom) {
  const Eigen::Vector3d size = Vector(model.geom_size + 3 * geom);
  switch (model.geom_type[geom]) {
    case mjGEOM_BOX:
    case mjGEOM_ELLIPSOID:
      return {size, 0};
    case mjGEOM_CYLINDER:
      return {{size.x(), size.x(), size.y()}, 0};
    case mjGEOM_CAPSULE:
      return {{0, 0, size.y()}, size.x()};
    default:
      return {Eigen::Vector3d::Zero(), model.geom_rbound[geom]};
  }
}

// The shapes that collide, of the bodies that hang on `base` but not on one of `hips`.
std::vector<TrunkShape> TrunkShapes(const mjModel& model, int base,
                                    const std::array<int, kLegs>& hips) {
  std::vector<TrunkShape> shapes;
  for (int geom = 0; geom < model.ngeom; ++geom) {
    const int body = model.geom_bodyid[geom];
    const bool collides = model.geom_contype[geom] != 0 || model.geom_conaffinity[geom] != 0;
    const bool of_leg =
        std::any_of(hips.begin(), hips.end(), [&](int hip) { return HangsOn(model, body, hip); });
    if (!collides || of_leg || !HangsOn(model, body, base)) continue;
    const Eigen::Quaterniond turn =
        TurnInAncestor(model, body, base, Quaternion(model.geom_quat + 4 * geom));
    const Eigen::Vector3d middle = InAncestor(model, body, base, Vector(model.geom_pos + 3 * geom));
    const Half half = HalfOf(model, geom);
    const Eigen::Vector3d reach = turn.toRotationMatrix().cwiseAbs() * half.size;
    shapes.push_back({Eigen::AlignedBox3d(middle - reach, middle + reach), half.rounding});
  }
  return shapes;
}

// The joint of that motor, which must turn about `axis` of its own body.
int Hinge(const mjModel& model, const std::string& name, const Eigen::Vector3d& axis) {
  const int joint = mj_name2id(&model, mjOBJ_JOINT, name.c_str());
  const bool fits = joint >= 0 && model.jnt_type[joint] == mjJNT_HINGE &&
                    Vector(model.jnt_axis + 3 * joint).isApprox(axis, 1e-3) &&
                    Vector(model.jnt_pos + 3 * joint).isZero(1e-6) &&
                    model.qpos0[model.jnt_qposadr[joint]] == 0;
  if (!fits) {
    throw ModelError("joint '" + name +
                     "': the motion service expects legs whose hips turn about x and whose thighs "
                     "and calves turn about y; switch it off or take another model");
  }
  return joint;
}

// `foot` are its geoms, of which the lowest treads.
void ReadFoot(const mjModel& model, const mjData& data, std::span<const int> foot, int calf,
              bool wheeled, LegFigures* figures) {
  const auto bottom = [&](int geom) { return physics::LowestPoint(model, data, geom); };
  const int geom = *std::ranges::min_element(foot, {}, bottom);
  figures->foot =
      InAncestor(model, model.geom_bodyid[geom], calf, Vector(model.geom_pos + 3 * geom));
  figures->radius = model.geom_size[3 * geom];
  switch (model.geom_type[geom]) {
    case mjGEOM_SPHERE:
      return;
    case mjGEOM_CYLINDER:
      figures->half_width = model.geom_size[3 * geom + 1];
      return;
    default:  // a mesh, of which only a tyre is as wide below as in its middle
      figures->radius = data.geom_xpos[3 * geom + 2] - bottom(geom);
      if (wheeled) figures->half_width = physics::Reach(model, geom, data.geom_xmat + 9 * geom + 3);
  }
}

LegFigures ReadLeg(const mjModel& model, const robot::RobotSpec& spec, std::size_t leg, int base) {
  LegFigures figures;
  std::array<int, 3> bodies{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string& name = spec.motors[3 * leg + i].joint;
    const int joint =
        Hinge(model, name, i == 0 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY());
    bodies[i] = model.jnt_bodyid[joint];
    const bool limited = model.jnt_limited[joint] != 0;
    constexpr double kFree = std::numeric_limits<double>::infinity();
    figures.low[i] = limited ? model.jnt_range[2 * joint] : -kFree;
    figures.high[i] = limited ? model.jnt_range[2 * joint + 1] : kFree;
    const int dof = model.jnt_dofadr[joint];
    const auto at = static_cast<Eigen::Index>(i);
    figures.armature[at] = model.dof_armature[dof];
    figures.damping[at] = model.dof_damping[dof];
    figures.friction[at] = model.dof_frictionloss[dof];
    if (!HangsOn(model, bodies[i], i == 0 ? base : bodies[i - 1])) {
      throw ModelError("joint '" + name + "': the motion service expects it to hang on the base " +
                       "or on the joint before it");
    }
  }
  const auto origin = [&](int body, int ancestor) {
    return InAncestor(model, body, ancestor, Eigen::Vector3d::Zero());
  };
  figures.hip = origin(bodies[0], base);
  figures.thigh = origin(bodies[1], bodies[0]);
  figures.calf = origin(bodies[2], bodies[1]);
  figures.links = {Lump(model, bodies[0], std::array{bodies[1]}),
                   Lump(model, bodies[1], std::array{bodies[2]}),
                   Lump(model, bodies[2], std::array<int, 0>{})};
  return figures;
}

}  // namespace

Eigen::Matrix3d PointInertia(double mass, const Eigen::Vector3d& p) {
  return mass * (p.squaredNorm() * Eigen::Matrix3d::Identity() - p * p.transpose());
}

QuadrupedFigures ReadQuadruped(const physics::RobotBody& robot) {
  const robot::RobotSpec& spec = robot.spec();
  const bool wheeled = spec.kind == robot::RobotKind::kWheeled;
  if (spec.motors.size() < kLegMotors + (wheeled ? kLegs : 0) || spec.feet.size() != kLegs) {
    throw ModelError("robot '" + spec.name +
                     "' is no quadruped: it needs 12 motors, 4 for wheels, and 4 feet");
  }
  const mjModel& model = robot.nominal();
  const int base = mj_name2id(&model, mjOBJ_BODY, spec.base_body.c_str());
  QuadrupedFigures figures;
  const mjcf::DataHandle data = mjcf::MakeDataWithoutContacts(model);
  mj_kinematics(&model, data.get());
  const std::vector<std::vector<int>> feet = physics::FootGeoms(model, *data, spec);
  const auto body_of = [&](std::size_t motor) {
    return model.jnt_bodyid[mj_name2id(&model, mjOBJ_JOINT, spec.motors[motor].joint.c_str())];
  };
  std::array<int, kLegs> hips{};
  for (std::size_t leg = 0; leg < kLegs; ++leg) {
    figures.legs[leg] = ReadLeg(model, spec, leg, base);
    hips[leg] = body_of(3 * leg);
    const int calf = body_of(3 * leg + 2);
    if (feet[leg].empty() || !HangsOn(model, model.geom_bodyid[feet[leg].front()], calf)) {
      throw ModelError("foot '" + spec.feet[leg].name + "' has no geoms on the calf of '" +
                       spec.motors[3 * leg + 2].joint + "': " + physics::FeetRemedy(leg));
    }
    ReadFoot(model, *data, feet[leg], calf, wheeled, &figures.legs[leg]);
  }
  figures.trunk = Lump(model, base, hips);
  figures.trunk_shapes = TrunkShapes(model, base, hips);
  figures.wheeled = wheeled;
  figures.mass = model.body_subtreemass[base];
  figures.gravity = -model.opt.gravity[2];
  const int site = mj_name2id(&model, mjOBJ_SITE, spec.imu.site.c_str());
  figures.R_BI =
      TurnInAncestor(model, model.site_bodyid[site], base, Quaternion(model.site_quat + 4 * site));
  figures.p_BI =
      InAncestor(model, model.site_bodyid[site], base, Vector(model.site_pos + 3 * site));
  return figures;
}

}  // namespace understudy::motion
