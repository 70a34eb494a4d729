#include "mjcf/look_reader.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <numbers>
#include <set>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "mjcf/assets.h"
#include "mjcf/defaults.h"
#include "mjcf/urdf_elements.h"

namespace understudy::mjcf {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using std::filesystem::path;

constexpr char kGrey[] = "0.7 0.7 0.7 1";
constexpr std::array<std::string_view, 4> kReadable = {".stl", ".obj", ".msh", ".dae"};
constexpr std::array<const char*, 1> kGeom = {"geom"};
constexpr std::array<const char*, 1> kMesh = {"mesh"};
constexpr std::array<const char*, 1> kMaterial = {"material"};

void CollectBodies(const MjcfElement& parent, bool of_world, Bodies* bodies) {
  for (const MjcfElement& child : parent.children) {
    if (child.name != "body") continue;
    const std::string name = child.Get("name");
    if (!name.empty()) {
      std::optional<Vector3d> at;
      if (!of_world) at = VectorIn(&child, "pos", Vector3d::Zero());
      bodies->at.emplace(name, at);
      for (const MjcfElement& joint : child.children) {
        if (joint.name == "joint") bodies->of_joint.emplace(joint.Get("name"), name);
      }
    }
    CollectBodies(child, false, bodies);
  }
}

// Collects the meshes of a model, by the bodies of the robot that they hang on.
class LookReader {
 public:
  LookReader(path file, const MjcfElement& root, const Bodies& robot)
      : defaults_(root), robot_(robot) {
    look_.file = std::move(file);
    degrees_ = CompilerSays(root, "angle") != "radian";
    for (const MjcfElement& section : root.children) {
      if (section.name != "asset") continue;
      for (const MjcfElement& asset : section.children) {
        if (asset.name == "mesh") meshes_.emplace(NameOf(asset), &asset);
        if (asset.name == "material") materials_.emplace(asset.Get("name"), &asset);
      }
    }
    for (const MjcfElement& section : root.children) {
      if (section.name == "worldbody") Walk(section, "", "", Isometry3d::Identity());
    }
  }

  Look TakeLook() { return std::move(look_); }
  const std::string& lacks() const { return lacks_; }  // the first mesh that cannot be read

 private:
  static std::string NameOf(const MjcfElement& mesh) {
    const std::string* name = mesh.Find("name");
    return name != nullptr ? *name : path(mesh.Get("file")).stem().string();
  }

  // What an element says, or its class; "" if neither does.
  std::string Says(const MjcfElement& element, const std::string& its_class,
                   std::span<const char* const> kinds, const char* attribute) const {
    const std::string* own = element.Find("class");
    const auto found =
        defaults_.Find(element, own != nullptr ? *own : its_class, kinds, {attribute});
    return found ? found->value : "";
  }

  Isometry3d PlaceOf(const MjcfElement& element) const {
    for (const char* other : {"xyaxes", "zaxis"}) {
      if (element.Find(other) != nullptr) {
        FailAt(element, std::string(other) + " is not read in a look; expected quat");
      }
    }
    const double unit = degrees_ ? std::numbers::pi / 180 : 1;
    Isometry3d place = Isometry3d::Identity();
    place.translation() = VectorIn(&element, "pos", Vector3d::Zero());
    const std::vector<double> q = NumbersIn(&element, "quat", {1, 0, 0, 0});
    place.linear() = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
    const std::vector<double> turn = NumbersIn(&element, "axisangle", {0, 0, 1, 0});
    if (element.Find("axisangle") != nullptr) {
      const Vector3d axis = Vector3d(turn[0], turn[1], turn[2]).normalized();
      place.linear() = Eigen::AngleAxisd(unit * turn[3], axis).toRotationMatrix();
    }
    if (element.Find("euler") != nullptr) {
      const Vector3d angles = unit * VectorIn(&element, "euler", Vector3d::Zero());
      place.linear() = (Eigen::AngleAxisd(angles.x(), Vector3d::UnitX()) *
                        Eigen::AngleAxisd(angles.y(), Vector3d::UnitY()) *
                        Eigen::AngleAxisd(angles.z(), Vector3d::UnitZ()))
                           .toRotationMatrix();
    }
    return place;
  }

  // What the robot calls that body; "" if it has none such.
  std::string OwnName(const MjcfElement& body) const {
    std::string name = body.Get("name");
    if (robot_.at.contains(name)) return name;
    for (const MjcfElement& joint : body.children) {
      if (joint.name != "joint") continue;
      const auto own = robot_.of_joint.find(joint.Get("name"));
      if (own != robot_.of_joint.end()) return own->second;
    }
    return "";
  }

  // `owner` is the robot's body on which `body` hangs, `X_OB` its place there.
  void Walk(const MjcfElement& body, std::string its_class, const std::string& owner,
            const Isometry3d& X_OB) {
    if (const std::string* own = body.Find("childclass")) its_class = *own;
    if (!owner.empty()) TakeMeshes(body, its_class, owner, X_OB);
    for (const MjcfElement& child : body.children) {
      if (child.name != "body") continue;
      if (const std::string name = OwnName(child); !name.empty()) {
        Walk(child, its_class, name, Isometry3d::Identity());
      } else {
        Walk(child, its_class, owner, owner.empty() ? X_OB : X_OB * PlaceOf(child));
      }
    }
  }

  // Those that do not collide; of a body that has none, those that do.
  void TakeMeshes(const MjcfElement& body, const std::string& its_class, const std::string& owner,
                  const Isometry3d& X_OB) {
    std::vector<const MjcfElement*> seen;
    std::vector<const MjcfElement*> touching;
    for (const MjcfElement& child : body.children) {
      if (child.name != "geom" || Says(child, its_class, kGeom, "mesh").empty()) continue;
      const bool touches = Says(child, its_class, kGeom, "contype") != "0" ||
                           Says(child, its_class, kGeom, "conaffinity") != "0";
      (touches ? touching : seen).push_back(&child);
    }
    for (const MjcfElement* geom : seen.empty() ? touching : seen) {
      const auto mesh = meshes_.find(Says(*geom, its_class, kGeom, "mesh"));
      if (mesh == meshes_.end() || !Use(*mesh->second)) continue;
      AddGeom(*geom, its_class, mesh->first, owner, X_OB);
    }
  }

  // Whether the mesh can be read. It is then one of the look's.
  bool Use(const MjcfElement& mesh) {
    const std::string name = "look_" + NameOf(mesh);
    if (!used_.contains(name)) {
      std::string lacks = WhatAssetLacks(mesh);
      const std::string ending = LowerEnding(mesh.Get("file"));
      if (lacks.empty() && mesh.Find("file") != nullptr &&
          std::ranges::find(kReadable, ending) == kReadable.end()) {
        lacks = mesh.Get("file") + ": expected STL, OBJ, MSH or DAE";
      }
      if (!lacks.empty()) {
        if (lacks_.empty()) lacks_ = mesh.place.text() + ": " + lacks;
        return false;
      }
      MjcfElement own = mesh;
      own.Set("name", name);
      own.Drop("class");
      if (const std::string scale = Says(mesh, "", kMesh, "scale"); !scale.empty()) {
        own.Set("scale", scale);
      }
      look_.meshes.push_back(std::move(own));
      used_.insert(name);
    }
    return true;
  }

  void AddGeom(const MjcfElement& geom, const std::string& its_class, const std::string& mesh,
               const std::string& owner, const Isometry3d& X_OB) {
    MjcfElement own{.name = "geom", .attributes = {}, .children = {}, .place = geom.place};
    for (const auto& [name, value] : {std::pair{"type", "mesh"},
                                      {"group", "2"},
                                      {"contype", "0"},
                                      {"conaffinity", "0"},
                                      {"mass", "0"}}) {
      own.Set(name, value);
    }
    own.Set("mesh", "look_" + mesh);
    own.Set("rgba", ColourOf(geom, its_class));
    const Isometry3d place = X_OB * PlaceOf(geom);
    SetPlace({place.translation(), Eigen::Quaterniond(place.linear())}, &own);
    if (look_.bodies.empty() || look_.bodies.back().body != owner) {
      const auto known = std::ranges::find(look_.bodies, owner, &LookOfBody::body);
      if (known != look_.bodies.end()) {
        known->geoms.push_back(std::move(own));
        return;
      }
      look_.bodies.push_back({owner, {}});
    }
    look_.bodies.back().geoms.push_back(std::move(own));
  }

  // MuJoCo takes the material's colour where the geom has the grey that it has without a word.
  std::string ColourOf(const MjcfElement& geom, const std::string& its_class) const {
    if (std::string own = Says(geom, its_class, kGeom, "rgba"); !own.empty()) return own;
    const auto material = materials_.find(Says(geom, its_class, kGeom, "material"));
    if (material == materials_.end()) return kGrey;
    std::string colour = Says(*material->second, "", kMaterial, "rgba");
    return colour.empty() ? kGrey : colour;
  }

  MjcfDefaults defaults_;
  const Bodies& robot_;
  Look look_;
  std::string lacks_;
  bool degrees_ = true;
  std::map<std::string, const MjcfElement*> meshes_, materials_;
  std::set<std::string> used_;
};

}  // namespace

Bodies BodiesOf(const MjcfElement& root) {
  Bodies bodies;
  for (const MjcfElement& section : root.children) {
    if (section.name == "worldbody") CollectBodies(section, true, &bodies);
  }
  return bodies;
}

std::string LowerEnding(const path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

Look ReadLook(path file, const MjcfElement& root, const Bodies& robot, std::string* lacks) {
  LookReader reader(std::move(file), root, robot);
  *lacks = reader.lacks();
  return reader.TakeLook();
}

}  // namespace understudy::mjcf
