#include "mjcf/looks.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include "mjcf/assets.h"
#include "mjcf/defaults.h"
#include "mjcf/joints.h"

namespace understudy::mjcf {
namespace {

constexpr std::array<const char*, 1> kGeomKinds = {"geom"};

// All attribute values except names; they include every reference to a name.
void CollectValues(const MjcfElement& element, std::set<std::string>* values) {
  for (const auto& [name, value] : element.attributes) {
    if (name != "name") values->insert(value);
  }
  for (const MjcfElement& child : element.children) CollectValues(child, values);
}

class Looks {
 public:
  explicit Looks(const MjcfElement& root) : defaults_(root) {
    CollectValues(root, &values_);
    for (const MjcfElement& section : root.children) {
      if (section.name == "worldbody") Walk(section, "", /*has_inertia=*/true);
    }
  }

  const std::set<const MjcfElement*>& geoms() const { return geoms_; }

 private:
  void Walk(const MjcfElement& body, std::string child_class, bool has_inertia) {
    if (const std::string* own = body.Find("childclass")) child_class = *own;
    for (const MjcfElement& child : body.children) {
      if (child.name == "geom" && IsLooks(child, child_class, has_inertia)) geoms_.insert(&child);
      if (child.name != "body") continue;
      const bool inertial =
          std::any_of(child.children.begin(), child.children.end(),
                      [](const MjcfElement& element) { return element.name == "inertial"; });
      Walk(child, child_class, inertial);
    }
  }

  bool IsLooks(const MjcfElement& geom, const std::string& child_class, bool has_inertia) const {
    const std::string name = geom.Get("name");
    if (!name.empty() && values_.contains(name)) return false;
    const std::string own = geom.Find("class") != nullptr ? geom.Get("class") : child_class;
    const auto is_zero = [&](const char* attribute) {
      const auto setting = defaults_.Find(geom, own, kGeomKinds, {attribute});
      return setting && ReadNumbers(*setting, attribute, 1)[0] == 0;
    };
    if (!is_zero("contype") || !is_zero("conaffinity")) return false;
    if (defaults_.Find(geom, own, kGeomKinds, {"fluidshape"})) return false;
    if (has_inertia) return true;
    const bool has_mass = defaults_.Find(geom, own, kGeomKinds, {"mass"}).has_value();
    return is_zero(has_mass ? "mass" : "density");
  }

  MjcfDefaults defaults_;
  std::set<std::string> values_;
  std::set<const MjcfElement*> geoms_;
};

// Copies the remaining elements: moving would change the addresses in `gone`.
MjcfElement Without(const MjcfElement& element, const std::set<const MjcfElement*>& gone) {
  MjcfElement rest{element.name, element.attributes, {}, element.place};
  for (const MjcfElement& child : element.children) {
    if (!gone.contains(&child)) rest.children.push_back(Without(child, gone));
  }
  return rest;
}

std::string MeshName(const MjcfElement& mesh) {
  const std::string* name = mesh.Find("name");
  return name != nullptr ? *name : std::filesystem::path(mesh.Get("file")).stem().string();
}

void CollectMeshes(const MjcfElement& element, std::set<std::string>* names) {
  if (const std::string* mesh = element.Find("mesh")) names->insert(*mesh);
  for (const MjcfElement& child : element.children) CollectMeshes(child, names);
}

void DropTextureNames(MjcfElement* element) {
  if (element->name == "material") {
    element->Drop("texture");
    element->children.clear();  // <layer>, each another texture
  }
  for (MjcfElement& child : element->children) DropTextureNames(&child);
}

std::string Count(int number, const std::string& what) {
  return std::to_string(number) + " " + what + (number == 1 ? "" : "s");
}

std::string Plural(int number, const std::string& what) {
  return std::to_string(number) + " " + what + (number == 1 ? "" : "es");
}

}  // namespace

std::string LeftOutLooks::text() const {
  if (geoms + meshes == 0) return "";
  return Count(geoms, "geom") + ", " + Plural(meshes, "mesh") + " and " +
         Count(textures, "texture") + " that are only looked at were left out";
}

std::set<const MjcfElement*> VisualGeoms(const MjcfElement& root) {
  if (CompilerSays(root, "inertiafromgeom") == "true") return {};
  return Looks(root).geoms();
}

LeftOutLooks LeaveOutLooks(MjcfElement* root) {
  LeftOutLooks left_out;
  const std::set<const MjcfElement*> geoms = VisualGeoms(*root);
  left_out.geoms = static_cast<int>(geoms.size());
  if (left_out.geoms > 0) *root = Without(*root, geoms);
  std::set<std::string> meshes;
  CollectMeshes(*root, &meshes);
  for (MjcfElement& section : root->children) {
    if (section.name != "asset") continue;
    std::erase_if(section.children, [&](const MjcfElement& asset) {
      const bool is_texture = asset.name == "texture" || asset.name == "skin";
      if (!is_texture && (asset.name != "mesh" || meshes.contains(MeshName(asset)))) return false;
      ++(is_texture ? left_out.textures : left_out.meshes);
      if (const std::string lacks = WhatAssetLacks(asset); !lacks.empty()) {
        left_out.missing.push_back(asset.place.text() + ": " + lacks);
      }
      return true;
    });
  }
  DropTextureNames(root);
  return left_out;
}

}  // namespace understudy::mjcf
