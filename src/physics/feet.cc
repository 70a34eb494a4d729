#include "physics/feet.h"

#include <algorithm>
#include <string>

#include <mujoco/mujoco.h>

#include "physics/geom_extent.h"

namespace understudy::physics {
namespace {

constexpr double kSameSole = 0.01;  // m, assumed: less than a calf's other geoms are above its foot

// "left" of left_foot and of left_ankle_roll_joint.
std::string Side(const std::string& name) { return name.substr(0, name.find('_')); }

// The joints of the motors of that side.
std::vector<std::string> JointsOfSide(const robot::RobotSpec& spec, const std::string& side) {
  std::vector<std::string> joints;
  for (const robot::MotorSpec& motor : spec.motors) {
    if (Side(motor.joint) == side) joints.push_back(motor.joint);
  }
  return joints;
}

}  // namespace

std::vector<int> LowestGeoms(const mjModel& model, const mjData& data,
                             const std::vector<std::string>& joints) {
  std::vector<int> moved;
  for (const std::string& name : joints) {
    const int joint = mj_name2id(&model, mjOBJ_JOINT, name.c_str());
    if (joint < 0) continue;
    for (int geom = 0; geom < static_cast<int>(model.ngeom); ++geom) {
      const bool is_moved = model.body_weldid[model.geom_bodyid[geom]] == model.jnt_bodyid[joint];
      if (is_moved && Collides(model, geom)) moved.push_back(geom);
    }
  }
  if (moved.empty()) return {};
  const auto bottom = [&](int geom) { return LowestPoint(model, data, geom); };
  const auto body = [&](int geom) { return model.body_weldid[model.geom_bodyid[geom]]; };
  const int lowest = *std::ranges::min_element(moved, {}, bottom);
  std::erase_if(moved, [&](int geom) {
    return body(geom) != body(lowest) || bottom(geom) >= bottom(lowest) + kSameSole;
  });
  return moved;
}

std::vector<std::vector<int>> FootGeoms(const mjModel& model, const mjData& data,
                                        const robot::RobotSpec& spec) {
  std::vector<std::vector<int>> feet;
  for (const robot::FootSpec& foot : spec.feet) {
    std::vector<int>& geoms = feet.emplace_back();
    for (const std::string& name : foot.geoms) {
      const int geom = mj_name2id(&model, mjOBJ_GEOM, name.c_str());
      if (geom >= 0) geoms.push_back(geom);
    }
    if (geoms.empty()) geoms = LowestGeoms(model, data, JointsOfSide(spec, Side(foot.name)));
  }
  return feet;
}

std::string FeetRemedy(std::size_t foot) {
  return "let its geoms collide (contype), or take the file that has their <pair>s, often a scene "
         "beside the model; robot.feet." +
         std::to_string(foot) + ".geoms names them";
}

std::vector<int> FindFeet(const mjModel& model, const mjData& data, const robot::RobotSpec& spec) {
  std::vector<int> foot_of_geom(static_cast<std::size_t>(model.ngeom), -1);
  const std::vector<std::vector<int>> feet = FootGeoms(model, data, spec);
  for (std::size_t foot = 0; foot < feet.size(); ++foot) {
    for (const int geom : feet[foot]) {
      foot_of_geom[static_cast<std::size_t>(geom)] = static_cast<int>(foot);
    }
  }
  return foot_of_geom;
}

}  // namespace understudy::physics
