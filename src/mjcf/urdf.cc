#include "mjcf/urdf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include <mujoco/mujoco.h>
#include <tinyxml2.h>

#include "base/errors.h"
#include "base/printed.h"
#include "mjcf/eigen_views.h"
#include "mjcf/scene_shapes.h"
#include "mjcf/stl.h"

namespace understudy::mjcf {
namespace {

using Eigen::Isometry3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using tinyxml2::XMLPrinter;

// A mesh is shown as a cylinder if it is so many times as long as thick, and no flatter than that.
// *Assumed*: limbs are, trunks are not.
constexpr double kLong = 1.3, kRound = 0.7;

std::string Numbers(std::span<const double> numbers) {
  std::string text;
  for (const double number : numbers) {
    text += (text.empty() ? "" : " ") + Printed("%.9g", number == 0 ? 0.0 : number);  // no "-0"
  }
  return text;
}

std::string Number(double number) { return Numbers({&number, 1}); }

// Roll, pitch and yaw about fixed axes, of which at the poles only the sum or difference of two is
// determined: roll is 0 there.
Vector3d RollPitchYaw(const Eigen::Matrix3d& r) {
  const double pitch = std::asin(std::clamp(-r(2, 0), -1.0, 1.0));
  if (std::abs(r(2, 0)) > 1 - 1e-12) return {0, pitch, std::atan2(-r(0, 1), r(1, 1))};
  return {std::atan2(r(2, 1), r(2, 2)), pitch, std::atan2(r(1, 0), r(0, 0))};
}

Isometry3d Pose(const double* position, const double* quaternion) {
  return Eigen::Translation3d(Vector(position)) * Quaternion(quaternion);
}

std::string StlOf(const mjModel& model, int mesh) {
  std::vector<float> corners;
  const float* const vertices =
      model.mesh_vert + 3 * static_cast<std::ptrdiff_t>(model.mesh_vertadr[mesh]);
  const int* const faces =
      model.mesh_face + 3 * static_cast<std::ptrdiff_t>(model.mesh_faceadr[mesh]);
  for (int i = 0; i < 3 * model.mesh_facenum[mesh]; ++i) {
    const float* const corner = vertices + 3 * static_cast<std::ptrdiff_t>(faces[i]);
    corners.insert(corners.end(), corner, corner + 3);
  }
  return Stl(corners);
}

class Writer {
 public:
  Writer(const mjModel& model, const std::map<std::string, UrdfLimits>& limits, MeshUse meshes)
      : model_(model), limits_(limits), meshes_(meshes) {}

  Urdf Write(const std::string& robot, const RobotTree& tree) {
    xml_.PushHeader(false, true);
    xml_.OpenElement("robot");
    xml_.PushAttribute("name", robot.c_str());
    WriteLink(tree.base, mj_name2id(&model_, mjOBJ_BODY, tree.base.c_str()));
    for (const TreeJoint& joint : tree.joints) {
      WriteJoint(joint);
      WriteLink(joint.child, joint.body);
    }
    xml_.CloseElement();
    urdf_.text = xml_.CStr();
    return std::move(urdf_);
  }

 private:
  void WriteJoint(const TreeJoint& joint) {
    const bool moves = joint.kind != TreeJoint::Kind::kFixed;
    const bool slides = joint.kind == TreeJoint::Kind::kSlide;
    const bool limited = moves && model_.jnt_limited[joint.joint] != 0;
    xml_.OpenElement("joint");
    xml_.PushAttribute("name", joint.name.c_str());
    xml_.PushAttribute("type", !moves    ? "fixed"
                               : slides  ? "prismatic"
                               : limited ? "revolute"
                                         : "continuous");
    Origin(joint.X_PC);
    Element("parent", {{"link", joint.parent}});
    Element("child", {{"link", joint.child}});
    if (moves) {
      Element("axis", {{"xyz", Numbers({joint.axis.data(), 3})}});
      Attributes limit;
      if (limited || slides) {
        constexpr double kFar = 1e3;  // URDF has no slide without an end
        const mjtNum* const range = model_.jnt_range + 2 * joint.joint;
        limit.emplace_back("lower", Number(limited ? range[0] : -kFar));
        limit.emplace_back("upper", Number(limited ? range[1] : kFar));
      }
      const auto known = limits_.find(joint.name);
      const UrdfLimits drive = known == limits_.end() ? UrdfLimits{} : known->second;
      limit.emplace_back("effort", Number(drive.effort));
      limit.emplace_back("velocity", Number(drive.velocity));
      Element("limit", limit);
      Element("dynamics", {{"damping", Number(model_.dof_damping[joint.dof])},
                           {"friction", Number(model_.dof_frictionloss[joint.dof])}});
    }
    xml_.CloseElement();
  }

  // Without mass and shape if there is no `body`.
  void WriteLink(const std::string& name, int body) {
    xml_.OpenElement("link");
    xml_.PushAttribute("name", name.c_str());
    if (body >= 0) WriteBody(body);
    xml_.CloseElement();
  }

  void WriteBody(int body) {
    if (model_.body_mass[body] > 0) {
      xml_.OpenElement("inertial");
      Origin(Pose(model_.body_ipos + 3 * body, model_.body_iquat + 4 * body));
      Element("mass", {{"value", Number(model_.body_mass[body])}});
      const double* const moments = model_.body_inertia + 3 * body;
      Element("inertia", {{"ixx", Number(moments[0])},
                          {"iyy", Number(moments[1])},
                          {"izz", Number(moments[2])},
                          {"ixy", "0"},
                          {"ixz", "0"},
                          {"iyz", "0"}});
      xml_.CloseElement();
    }
    const int first = model_.body_geomadr[body];
    for (int geom = first; geom < first + model_.body_geomnum[body]; ++geom) {
      const bool collides = model_.geom_contype[geom] != 0 || model_.geom_conaffinity[geom] != 0;
      if (model_.geom_group[geom] <= kLastSeenGroup) WriteGeom("visual", geom);
      if (collides) WriteGeom("collision", geom);
    }
  }

  void WriteGeom(const char* use, int geom) {
    const Isometry3d pose = Pose(model_.geom_pos + 3 * geom, model_.geom_quat + 4 * geom);
    const double* const size = model_.geom_size + 3 * geom;
    const auto sphere = [&](const Isometry3d& at, double radius) {
      WriteShape(use, geom, at, "sphere", {{"radius", Number(radius)}});
    };
    const auto cylinder = [&] {
      WriteShape(use, geom, pose, "cylinder",
                 {{"radius", Number(size[0])}, {"length", Number(2 * size[1])}});
    };
    switch (model_.geom_type[geom]) {
      case mjGEOM_SPHERE:
        return sphere(pose, size[0]);
      case mjGEOM_ELLIPSOID:
        return sphere(pose, std::max({size[0], size[1], size[2]}));
      case mjGEOM_CYLINDER:
        return cylinder();
      case mjGEOM_CAPSULE:
        cylinder();
        for (const double end : {-size[1], size[1]}) {
          sphere(pose * Eigen::Translation3d(0, 0, end), size[0]);
        }
        return;
      case mjGEOM_BOX: {
        const std::array<double, 3> whole{2 * size[0], 2 * size[1], 2 * size[2]};
        return WriteShape(use, geom, pose, "box", {{"size", Numbers(whole)}});
      }
      case mjGEOM_MESH: {
        if (meshes_ == MeshUse::kPrimitives) {
          return WritePrimitive(use, geom, pose, ExtentOf(model_.geom_dataid[geom]));
        }
        const std::string name = RobotsName(model_, mjOBJ_MESH, model_.geom_dataid[geom]);
        if (std::ranges::find(urdf_.meshes, name, &UrdfMesh::name) == urdf_.meshes.end()) {
          urdf_.meshes.push_back({name, StlOf(model_, model_.geom_dataid[geom])});
        }
        return WriteShape(use, geom, pose, "mesh", {{"filename", "meshes/" + name + ".stl"}});
      }
      default:
        throw ModelError("URDF has no equal of a plane or height field that is part of a robot");
    }
  }

  // In place of a mesh that reaches so far.
  void WritePrimitive(const char* use, int geom, const Isometry3d& pose,
                      const Eigen::AlignedBox3d& box) {
    const Vector3d whole = box.sizes();
    int axis = 0;
    const double length = whole.maxCoeff(&axis);
    const double a = whole[(axis + 1) % 3], b = whole[(axis + 2) % 3];
    const Isometry3d middle = pose * Eigen::Translation3d(box.center());
    if (length < kLong * std::max(a, b) || std::min(a, b) < kRound * std::max(a, b)) {
      return WriteShape(use, geom, middle, "box", {{"size", Numbers({whole.data(), 3})}});
    }
    const auto turn = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), Vector3d::Unit(axis));
    WriteShape(use, geom, Isometry3d(middle * turn), "cylinder",
               {{"radius", Number((a + b) / 4)}, {"length", Number(length)}});
  }

  Eigen::AlignedBox3d ExtentOf(int mesh) const {
    Eigen::AlignedBox3d box;
    const int first = model_.mesh_vertadr[mesh];
    for (int i = first; i < first + model_.mesh_vertnum[mesh]; ++i) {
      box.extend(Eigen::Map<const Eigen::Vector3f>(model_.mesh_vert + 3 * i).cast<double>());
    }
    return box;
  }

  using Attributes = std::vector<std::pair<const char*, std::string>>;

  void WriteShape(const std::string& use, int geom, const Isometry3d& pose, const char* shape,
                  const Attributes& size) {
    xml_.OpenElement(use.c_str());
    Origin(pose);
    xml_.OpenElement("geometry");
    Element(shape, size);
    xml_.CloseElement();
    if (use == "visual") {
      const int material = model_.geom_matid[geom];
      const float* const rgba =
          material >= 0 ? model_.mat_rgba + 4 * material : model_.geom_rgba + 4 * geom;
      xml_.OpenElement("material");
      std::array<double, 4> colour{};
      std::transform(rgba, rgba + 4, colour.begin(),
                     [](float part) { return std::round(part * 1e4) / 1e4; });
      xml_.PushAttribute("name", ("rgba " + Numbers(colour)).c_str());
      Element("color", {{"rgba", Numbers(colour)}});
      xml_.CloseElement();
    }
    xml_.CloseElement();
  }

  void Origin(const Isometry3d& pose) {
    const Vector3d position = pose.translation(), angles = RollPitchYaw(pose.linear());
    Element("origin",
            {{"xyz", Numbers({position.data(), 3})}, {"rpy", Numbers({angles.data(), 3})}});
  }

  void Element(const char* name, const Attributes& attributes) {
    xml_.OpenElement(name);
    for (const auto& [key, value] : attributes) xml_.PushAttribute(key, value.c_str());
    xml_.CloseElement();
  }

  const mjModel& model_;
  const std::map<std::string, UrdfLimits>& limits_;
  MeshUse meshes_;
  XMLPrinter xml_;
  Urdf urdf_;
};

}  // namespace

Urdf UrdfOf(const mjModel& model, const std::string& robot, const RobotTree& tree,
            const std::map<std::string, UrdfLimits>& limits, MeshUse meshes) {
  return Writer(model, limits, meshes).Write(robot, tree);
}

}  // namespace understudy::mjcf
