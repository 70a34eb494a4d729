#include "mjcf/randomize_model.h"

#include <cmath>
#include <numbers>
#include <string>

#include <mujoco/mujoco.h>

#include "mjcf/mujoco_handles.h"

namespace understudy::mjcf {
namespace {

using Limits = robot::RandomizationSpec::Limits;

constexpr const char* kAxes[] = {"x", "y", "z"};

int Find(const mjModel& model, mjtObj type, const std::string& name) {
  return mj_name2id(&model, type, name.c_str());
}

std::string BodyName(const mjModel& model, int body) {
  const char* name = mj_id2name(&model, mjOBJ_BODY, body);
  return name == nullptr || *name == '\0' ? "body " + std::to_string(body) : name;
}

bool IsBelow(const mjModel& model, int body, int ancestor) {
  while (body > ancestor) body = model.body_parentid[body];
  return body == ancestor;
}

void RandomizeBodies(const robot::RandomizationSpec& ranges, int base,
                     robot::Randomizer* randomizer, mjModel* model) {
  for (int body = base; body < static_cast<int>(model->nbody); ++body) {
    if (!IsBelow(*model, body, base) || model->body_mass[body] <= 0) continue;
    const std::string name = BodyName(*model, body);
    const double mass = randomizer->DrawOr("mass", name, ranges.mass, 1);
    const double inertia = mass * randomizer->DrawOr("inertia", name, ranges.inertia, 1);
    model->body_mass[body] *= mass;
    mju_scl3(model->body_inertia + 3 * body, model->body_inertia + 3 * body, inertia);
  }
}

// Clears MuJoCo's flags of coinciding frames, for which it ignores the numbers.
void ForgetCoincidences(int body, mjModel* model) {
  model->body_sameframe[body] = 0;
  for (int geom = 0; geom < static_cast<int>(model->ngeom); ++geom) {
    if (model->geom_bodyid[geom] == body) model->geom_sameframe[geom] = 0;
  }
  for (int site = 0; site < static_cast<int>(model->nsite); ++site) {
    if (model->site_bodyid[site] == body) model->site_sameframe[site] = 0;
  }
#if mjVERSION_HEADER >= 300
  model->opt.disableflags |= mjDSBL_MIDPHASE;  // its boxes are placed by centres of mass
#endif
}

void MoveCentreOfMass(const Limits& limits, const std::string& base_body,
                      robot::Randomizer* randomizer, mjModel* model) {
  if (limits.empty()) return;
  const int base = Find(*model, mjOBJ_BODY, base_body);
  // Of several robots the axes have the name of theirs, as "left/x".
  const std::string prefix = base_body.substr(0, base_body.find('/') + 1);
  mjtNum offset[3];
  for (int i = 0; i < 3; ++i)
    offset[i] = randomizer->DrawOr("base_com", prefix + kAxes[i], limits, 0);
  mju_addTo3(model->body_ipos + 3 * base, offset);
  ForgetCoincidences(base, model);
}

void RandomizeJoints(const robot::RandomizationSpec& ranges, const robot::RobotSpec& robot,
                     robot::Randomizer* randomizer, mjModel* model) {
  for (const robot::MotorSpec* motor : robot::AllMotors(robot)) {
    const std::string& name = motor->joint;
    const int dof = model->jnt_dofadr[Find(*model, mjOBJ_JOINT, name)];
    model->dof_damping[dof] *= randomizer->DrawOr("damping", name, ranges.damping, 1);
    model->dof_armature[dof] *= randomizer->DrawOr("armature", name, ranges.armature, 1);
    model->dof_frictionloss[dof] *=
        randomizer->DrawOr("frictionloss", name, ranges.frictionloss, 1);
  }
}

// One factor for all geoms, since a contact has the larger friction of the two.
void RandomizeFriction(const Limits& limits, robot::Randomizer* randomizer, mjModel* model) {
  const double factor = randomizer->DrawOr("friction", "", limits, 1);
  for (int geom = 0; geom < static_cast<int>(model->ngeom); ++geom) {
    model->geom_friction[3 * geom] *= factor;
  }
  for (int pair = 0; pair < static_cast<int>(model->npair); ++pair) {
    model->pair_friction[5 * pair] *= factor;
    model->pair_friction[5 * pair + 1] *= factor;
  }
}

// solref is a time constant and a damping ratio, or both negative, stiffness and damping.
// Compliance is proportional to the square of the time constant, or to 1 / stiffness; the damping
// ratio does not change.
void Soften(double factor, mjtNum* solref) {
  if (solref[0] > 0) {
    solref[0] *= std::sqrt(factor);
  } else {
    solref[0] /= factor;
    solref[1] /= std::sqrt(factor);
  }
}

void RandomizeSoftness(const Limits& limits, robot::Randomizer* randomizer, mjModel* model) {
  if (limits.empty()) return;
  const double factor = randomizer->DrawOr("floor_softness", "", limits, 1);
  for (int geom = 0; geom < static_cast<int>(model->ngeom); ++geom) {
    Soften(factor, model->geom_solref + mjNREF * geom);
  }
  for (int pair = 0; pair < static_cast<int>(model->npair); ++pair) {
    Soften(factor, model->pair_solref + mjNREF * pair);
  }
}

void TurnImu(const Limits& limits, const std::string& site_name, robot::Randomizer* randomizer,
             mjModel* model) {
  if (limits.empty() || site_name.empty()) return;
  const int site = Find(*model, mjOBJ_SITE, site_name);
  mjtNum rotation[3];
  for (int i = 0; i < 3; ++i) {
    rotation[i] = randomizer->DrawOr("imu_mounting", site_name + " " + kAxes[i], limits, 0);
  }
  const mjtNum angle = mju_normalize3(rotation);
  mjtNum turn[4], turned[4];
  mju_axisAngle2Quat(turn, rotation, angle);
  mju_mulQuat(turned, model->site_quat + 4 * site, turn);
  mju_copy4(model->site_quat + 4 * site, turned);
  model->site_sameframe[site] = 0;
}

void TiltGravity(const Limits& limits, robot::Randomizer* randomizer, mjModel* model) {
  if (limits.empty()) return;
  const double angle = randomizer->DrawOr("gravity_tilt", "angle", limits, 0);
  const double side = randomizer->Draw("gravity_tilt", "side", 0, 2 * std::numbers::pi);
  const mjtNum axis[3] = {std::cos(side), std::sin(side), 0};
  mjtNum turn[4], tilted[3];
  mju_axisAngle2Quat(turn, axis, angle);
  mju_rotVecQuat(tilted, model->opt.gravity, turn);
  mju_copy3(model->opt.gravity, tilted);
}

}  // namespace

void RandomizeModel(const robot::RandomizationSpec& ranges,
                    std::span<const robot::RobotSpec> robots, robot::Randomizer* randomizer,
                    mjModel* model) {
  RandomizeFriction(ranges.friction, randomizer, model);
  for (const robot::RobotSpec& robot : robots) {
    RandomizeBodies(ranges, Find(*model, mjOBJ_BODY, robot.base_body), randomizer, model);
    MoveCentreOfMass(ranges.base_com, robot.base_body, randomizer, model);
    RandomizeJoints(ranges, robot, randomizer, model);
    TurnImu(ranges.imu_mounting, robot.imu.site, randomizer, model);
    TurnImu(ranges.imu_mounting, robot.imu.secondary_site, randomizer, model);
  }
  TiltGravity(ranges.gravity_tilt, randomizer, model);
  RandomizeSoftness(ranges.floor_softness, randomizer, model);
  const DataHandle data(mj_makeData(model));
  mj_setConst(model, data.get());
}

}  // namespace understudy::mjcf
