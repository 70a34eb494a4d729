#include "mjcf/robot_tree.h"

#include <mujoco/mujoco.h>

#include "base/errors.h"
#include "mjcf/eigen_views.h"

namespace understudy::mjcf {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;

class TreeMaker {
 public:
  explicit TreeMaker(const mjModel& model) : model_(model) {}

  RobotTree Make(int base) {
    tree_.base = RobotsName(model_, mjOBJ_BODY, base);
    const int first = model_.body_jntadr[base];
    if (first >= 0 && model_.jnt_type[first] == mjJNT_FREE) {
      tree_.base_qpos = model_.jnt_qposadr[first];
    }
    for (int body = base; body > 0; body = model_.body_parentid[body]) {
      tree_.X_WB = PoseOf(body) * tree_.X_WB;
    }
    for (int body = base + 1; body < model_.nbody; ++body) {
      if (IsBelow(body, base)) Add(body);
    }
    return std::move(tree_);
  }

 private:
  bool IsBelow(int body, int base) const {
    while (body > base) body = model_.body_parentid[body];
    return body == base;
  }

  Isometry3d PoseOf(int body) const {
    return Translation3d(Vector(model_.body_pos + 3 * body)) *
           Quaternion(model_.body_quat + 4 * body);
  }

  // The joints that lead to a body, one behind the other.
  void Add(int body) {
    const std::string name = RobotsName(model_, mjOBJ_BODY, body);
    std::string parent = RobotsName(model_, mjOBJ_BODY, model_.body_parentid[body]);
    Isometry3d from = PoseOf(body);
    const int first = model_.body_jntadr[body], count = model_.body_jntnum[body];
    for (int id = first; id < first + count; ++id) {
      const Vector3d place = Vector(model_.jnt_pos + 3 * id);
      const bool last = id == first + count - 1 && place.isZero(1e-9);
      TreeJoint joint{.name = RobotsName(model_, mjOBJ_JOINT, id),
                      .kind = KindOf(id),
                      .parent = parent,
                      .axis = Vector(model_.jnt_axis + 3 * id),
                      .joint = id,
                      .body = last ? body : -1,
                      .qpos = model_.jnt_qposadr[id],
                      .dof = model_.jnt_dofadr[id]};
      joint.child = last ? name : joint.name + "_place";
      // The file's pose is the one at qpos0.
      joint.X_PC = from * Translation3d(place);
      joint.X_PC = joint.At(-model_.qpos0[joint.qpos]);
      parent = joint.child;
      tree_.joints.push_back(std::move(joint));
      from = Translation3d(-place);
    }
    if (parent == name) return;
    tree_.joints.push_back(
        {.name = name + "_fixed", .parent = parent, .child = name, .X_PC = from, .body = body});
  }

  TreeJoint::Kind KindOf(int joint) const {
    const int type = model_.jnt_type[joint];
    if (type == mjJNT_HINGE) return TreeJoint::Kind::kHinge;
    if (type == mjJNT_SLIDE) return TreeJoint::Kind::kSlide;
    throw ModelError("URDF has no equal of joint '" +
                     std::string(RobotsName(model_, mjOBJ_JOINT, joint)) +
                     "': it knows hinges and slides");
  }

  const mjModel& model_;
  RobotTree tree_;
};

}  // namespace

const char* RobotsName(const mjModel& model, int type, int id) {
  const char* const name = mj_id2name(&model, type, id);
  if (name == nullptr || *name == '\0') {
    throw ModelError("a " + std::string(mju_type2Str(type)) + " of the robot has no name");
  }
  return name;
}

Isometry3d TreeJoint::At(double q) const {
  switch (kind) {
    case Kind::kFixed:
      break;
    case Kind::kHinge:
      return X_PC * AngleAxisd(q, axis);
    case Kind::kSlide:
      return X_PC * Translation3d(q * axis);
  }
  return X_PC;
}

RobotTree TreeOf(const mjModel& model, const std::string& base) {
  const int body = mj_name2id(&model, mjOBJ_BODY, base.c_str());
  if (body < 0) throw ModelError("the model has no body '" + base + "'");
  return TreeMaker(model).Make(body);
}

}  // namespace understudy::mjcf
