#include "mjcf/urdf.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <span>

#include <mujoco/mujoco.h>
#include <tinyxml2.h>

#include "base/errors.h"
#include "mjcf/eigen_views.h"

namespace understudy::mjcf {
namespace {

using Eigen::Isometry3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using tinyxml2::XMLPrinter;

constexpr int kLastSeenGroup = 2;  // of those that MuJoCo shows unless asked

std::string Numbers(std::span<const double> numbers) {
  std::string text;
  for (const double number : numbers) {
    std::array<char, 32> digits{};
    std::snprintf(digits.data(), digits.size(), "%.9g", number == 0 ? 0.0 : number);  // no "-0"
    text += (text.empty() ? "" : " ") + std::string(digits.data());
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

const char* NameOf(const mjModel& model, int type, int id) {
  const char* const name = mj_id2name(&model, type, id);
  if (name == nullptr || *name == '\0') {
    throw ModelError("URDF: a " + std::string(mju_type2Str(type)) + " of the robot has no name");
  }
  return name;
}

// A solid of three vertices each, without normals: readers compute them.
std::string Stl(const mjModel& model, int mesh) {
  const auto faces = static_cast<std::uint32_t>(model.mesh_facenum[mesh]);
  std::string bytes(80, '\0');
  const auto add = [&](const void* from, std::size_t size) {
    bytes.append(static_cast<const char*>(from), size);
  };
  static_assert(std::endian::native == std::endian::little);
  add(&faces, sizeof faces);
  const float* const vertices =
      model.mesh_vert + 3 * static_cast<std::ptrdiff_t>(model.mesh_vertadr[mesh]);
  const int* const corners =
      model.mesh_face + 3 * static_cast<std::ptrdiff_t>(model.mesh_faceadr[mesh]);
  for (std::uint32_t i = 0; i < faces; ++i) {
    const std::array<float, 3> normal{};
    add(normal.data(), sizeof normal);
    for (std::uint32_t k = 0; k < 3; ++k) {
      add(vertices + 3 * static_cast<std::ptrdiff_t>(corners[3 * i + k]), 3 * sizeof(float));
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

class Writer {
 public:
  Writer(const mjModel& model, const std::map<std::string, UrdfLimits>& limits)
      : model_(model), limits_(limits) {}

  Urdf Write(const std::string& robot, int base) {
    xml_.PushHeader(false, true);
    xml_.OpenElement("robot");
    xml_.PushAttribute("name", robot.c_str());
    WriteLink(NameOf(model_, mjOBJ_BODY, base), base);
    for (int body = base + 1; body < model_.nbody; ++body) {
      if (IsBelow(body, base)) WriteBody(body);
    }
    xml_.CloseElement();
    urdf_.text = xml_.CStr();
    return std::move(urdf_);
  }

 private:
  bool IsBelow(int body, int base) const {
    while (body > base) body = model_.body_parentid[body];
    return body == base;
  }

  // The joints that lead to a body, one behind the other, and its link.
  void WriteBody(int body) {
    const std::string name = NameOf(model_, mjOBJ_BODY, body);
    std::string parent = NameOf(model_, mjOBJ_BODY, model_.body_parentid[body]);
    Isometry3d from = Pose(model_.body_pos + 3 * body, model_.body_quat + 4 * body);
    const int first = model_.body_jntadr[body], count = model_.body_jntnum[body];
    for (int joint = first; joint < first + count; ++joint) {
      const Vector3d place = Vector(model_.jnt_pos + 3 * joint);
      const bool last = joint == first + count - 1 && place.isZero(1e-9);
      const std::string link =
          last ? name : NameOf(model_, mjOBJ_JOINT, joint) + std::string("_place");
      from.translate(place);
      WriteJoint(joint, parent, link, from);
      if (!last) WriteEmptyLink(link);
      parent = link;
      from = Eigen::Translation3d(-place);
    }
    if (parent != name) WriteFixedJoint(name + "_fixed", parent, name, from);
    WriteLink(name, body);
  }

  void WriteJoint(int joint, const std::string& parent, const std::string& child,
                  const Isometry3d& origin) {
    const std::string name = NameOf(model_, mjOBJ_JOINT, joint);
    const int type = model_.jnt_type[joint];
    if (type != mjJNT_HINGE && type != mjJNT_SLIDE) {
      throw ModelError("URDF has no equal of joint '" + name + "': it knows hinges and slides");
    }
    const bool limited = model_.jnt_limited[joint] != 0;
    OpenJoint(name,
              type == mjJNT_SLIDE ? "prismatic"
              : limited           ? "revolute"
                                  : "continuous",
              parent, child, origin);
    Element("axis", {{"xyz", Numbers({model_.jnt_axis + 3 * joint, 3})}});
    Attributes limit;
    if (limited || type == mjJNT_SLIDE) {
      constexpr double kFar = 1e3;  // URDF has no slide without an end
      limit.emplace_back("lower", Number(limited ? model_.jnt_range[2 * joint] : -kFar));
      limit.emplace_back("upper", Number(limited ? model_.jnt_range[2 * joint + 1] : kFar));
    }
    const auto known = limits_.find(name);
    const UrdfLimits drive = known == limits_.end() ? UrdfLimits{} : known->second;
    limit.emplace_back("effort", Number(drive.effort));
    limit.emplace_back("velocity", Number(drive.velocity));
    Element("limit", limit);
    const int dof = model_.jnt_dofadr[joint];
    Element("dynamics", {{"damping", Number(model_.dof_damping[dof])},
                         {"friction", Number(model_.dof_frictionloss[dof])}});
    xml_.CloseElement();
  }

  void WriteFixedJoint(const std::string& name, const std::string& parent, const std::string& child,
                       const Isometry3d& origin) {
    OpenJoint(name, "fixed", parent, child, origin);
    xml_.CloseElement();
  }

  void OpenJoint(const std::string& name, const char* type, const std::string& parent,
                 const std::string& child, const Isometry3d& origin) {
    xml_.OpenElement("joint");
    xml_.PushAttribute("name", name.c_str());
    xml_.PushAttribute("type", type);
    Origin(origin);
    Element("parent", {{"link", parent}});
    Element("child", {{"link", child}});
  }

  void WriteEmptyLink(const std::string& name) { Element("link", {{"name", name}}); }

  void WriteLink(const std::string& name, int body) {
    xml_.OpenElement("link");
    xml_.PushAttribute("name", name.c_str());
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
    xml_.CloseElement();
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
        const std::string name = NameOf(model_, mjOBJ_MESH, model_.geom_dataid[geom]);
        if (std::ranges::find(urdf_.meshes, name, &UrdfMesh::name) == urdf_.meshes.end()) {
          urdf_.meshes.push_back({name, Stl(model_, model_.geom_dataid[geom])});
        }
        return WriteShape(use, geom, pose, "mesh", {{"filename", "meshes/" + name + ".stl"}});
      }
      default:
        throw ModelError("URDF has no equal of a plane or height field that is part of a robot");
    }
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
  XMLPrinter xml_;
  Urdf urdf_;
};

}  // namespace

Urdf UrdfOf(const mjModel& model, const std::string& robot, const std::string& base,
            const std::map<std::string, UrdfLimits>& limits) {
  const int body = mj_name2id(&model, mjOBJ_BODY, base.c_str());
  if (body < 0) throw ModelError("the model has no body '" + base + "'");
  return Writer(model, limits).Write(robot, body);
}

}  // namespace understudy::mjcf
