#include "mjcf/urdf_reader.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <Eigen/Geometry>
#include <tinyxml2.h>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "mjcf/joints.h"
#include "mjcf/urdf_elements.h"
#include "mjcf/urdf_inertial.h"
#include "mjcf/urdf_meshes.h"

namespace understudy::mjcf {
namespace {

using Eigen::Vector3d;
using std::filesystem::path;

constexpr double kRotorInertia = 0.01;        // kg·m² at the joint, assumed
constexpr std::size_t kMostLinksInARow = 90;  // of the levels that MuJoCo reads
constexpr char kWorldLink[] = "world";        // the name of ROS for what robots are tied to

class UrdfTree {
 public:
  UrdfTree(const path& file, DaeUse dae)
      : root_(ReadXml(file)), meshes_(std::filesystem::absolute(file).parent_path(), dae) {
    if (root_.name != "robot") {
      FailAt(root_, "expected URDF, whose first element is <robot>, not <" + root_.name + ">");
    }
    for (const MjcfElement& element : root_.children) {
      if (element.name.starts_with("xacro:")) {
        FailAt(element, "this is xacro; make URDF of it first: xacro FILE > my.urdf");
      }
      if (element.name == "link") {
        if (!links_.try_emplace(NeededIn(element, "name"), &element).second) {
          FailAt(element, "there is a link '" + element.Get("name") + "' already");
        }
      } else if (element.name == "material") {
        if (const MjcfElement* color = ChildOf(element, "color")) {
          colors_[element.Get("name")] = color;
        }
      }
    }
    if (links_.empty()) FailAt(root_, "<robot> has no link");
  }

  UrdfRobot Read() {
    ReadJoints();
    std::vector<std::string> roots;
    for (const auto& [name, link] : links_) {
      if (!parents_.contains(name)) roots.push_back(name);
    }
    if (roots.size() != 1) {
      std::string names;
      for (const std::string& name : roots) names += (names.empty() ? "" : ", ") + name;
      FailAt(root_, roots.empty()
                        ? "every link has a parent: they form a ring"
                        : "links without a parent: " + names + "; expected one, the base");
    }
    const MjcfElement* const tie = TieToWorld(roots.front());
    robot_.base = tie == nullptr ? roots.front() : LinkOf(*tie, "child");
    robot_.fixed = tie != nullptr && tie->Get("type") == "fixed";
    robot_.model = {.name = "mujoco", .attributes = {}, .children = {}, .place = root_.place};
    robot_.model.Set("model", root_.Get("name"));
    MjcfElement world = Made("worldbody");
    world.children.push_back(Body(*links_.at(robot_.base), robot_.fixed ? tie : nullptr, 1));
    const std::size_t places = tie == nullptr ? 0 : 1;  // links that are no bodies
    if (robot_.bodies.size() + places != links_.size()) FailAt(root_, "some links form a ring");
    AddHead();
    robot_.model.children.push_back(std::move(world));
    return std::move(robot_);
  }

 private:
  MjcfElement Made(const std::string& name) const { return {name, {}, {}, root_.place}; }

  std::string LinkOf(const MjcfElement& joint, const std::string& end) const {
    const MjcfElement* element = ChildOf(joint, end);
    if (element == nullptr) FailAt(joint, "<joint> '" + joint.Get("name") + "' has no " + end);
    std::string link = NeededIn(*element, "link");
    if (links_.contains(link)) return link;
    std::vector<std::string> names;
    for (const auto& [name, ignored] : links_) names.push_back(name);
    FailAt(*element, "no link '" + link + "'" + NearestHint(link, names));
  }

  // Returns the joint that ties the base to a root link which only names the world: a floating one,
  // or any of a root that is called "world". Null if the root is the base itself.
  const MjcfElement* TieToWorld(const std::string& root) {
    const std::vector<const MjcfElement*>& joints = children_[root];
    const auto floats = [](const MjcfElement* one) { return one->Get("type") == "floating"; };
    if (root != kWorldLink && std::ranges::none_of(joints, floats)) return nullptr;
    const MjcfElement& link = *links_.at(root);
    const std::string stands = "link '" + root + "' stands for the world; expected ";
    for (const MjcfElement& part : link.children) {
      if (part.name == "inertial" || part.name == "visual" || part.name == "collision") {
        FailAt(part, stands + "it without <" + part.name + ">");
      }
    }
    if (joints.size() != 1) FailAt(link, stands + "one joint below it, the base's");
    const std::string type = joints.front()->Get("type");
    if (type != "fixed" && type != "floating") {
      FailAt(*joints.front(), stands + "a fixed or a floating joint below it, not " + type);
    }
    return joints.front();
  }

  void ReadJoints() {
    std::set<std::string> names;
    for (const MjcfElement& joint : root_.children) {
      if (joint.name != "joint") continue;
      const std::string name = NeededIn(joint, "name");
      if (!names.insert(name).second) FailAt(joint, "there is a joint '" + name + "' already");
      const std::string child = LinkOf(joint, "child");
      children_[LinkOf(joint, "parent")].push_back(&joint);
      if (!parents_.insert(child).second)
        FailAt(joint, "link '" + child + "' has a parent already");
    }
  }

  MjcfElement Body(const MjcfElement& link, const MjcfElement* joint, std::size_t level) {
    const std::string name = link.Get("name");
    if (level > kMostLinksInARow) FailAt(link, "more than 90 links in a row");
    robot_.bodies.push_back(name);
    MjcfElement body = Made("body");
    body.Set("name", name);
    if (joint != nullptr) SetPlace(OriginOf(*joint), &body);
    const bool moves = joint == nullptr || joint->Get("type") != "fixed";
    if (auto inertial = InertialOf(link, moves, &robot_.notes)) {
      body.children.push_back(*std::move(inertial));
    }
    if (joint == nullptr) {
      body.children.push_back(Made("freejoint"));
    } else if (moves) {
      body.children.push_back(Joint(*joint));
    }
    AddGeoms(link, &body);
    for (const MjcfElement* next : children_[name]) {
      body.children.push_back(Body(*links_.at(LinkOf(*next, "child")), next, level + 1));
    }
    return body;
  }

  // A link whose looks are all left out looks as it collides.
  void AddGeoms(const MjcfElement& link, MjcfElement* body) {
    std::vector<MjcfElement> colliding;
    int looks = 0, left_out = 0;
    for (const MjcfElement& child : link.children) {
      const bool visual = child.name == "visual";
      if (!visual && child.name != "collision") continue;
      MjcfElement at = Made("geom");
      at.Set("class", child.name);
      SetPlace(OriginOf(child), &at);
      std::vector<MjcfElement> geoms = Shapes(child, visual, std::move(at));
      (geoms.empty() ? left_out : looks) += visual ? 1 : 0;
      for (MjcfElement& geom : geoms) {
        if (visual) {
          if (geom.Find("rgba") == nullptr) Paint(child, &geom);
        } else {
          colliding.push_back(geom);
          const std::size_t number = colliding.size();
          geom.Set("name", link.Get("name") + "_collision" +
                               (number == 1 ? "" : "_" + std::to_string(number)));
        }
        body->children.push_back(std::move(geom));
      }
    }
    if (looks > 0 || left_out == 0) return;
    for (MjcfElement& geom : colliding) {
      geom.Set("class", "visual");
      body->children.push_back(std::move(geom));
    }
  }

  MjcfElement Joint(const MjcfElement& joint) {
    const std::string name = joint.Get("name"), type = NeededIn(joint, "type");
    if (type != "revolute" && type != "continuous" && type != "prismatic") {
      FailAt(joint,
             "joint '" + name + "' is " + type +
                 "; expected fixed, revolute, continuous or prismatic (floating only between "
                 "a root link that is empty and the base)");
    }
    const Vector3d axis = VectorIn(ChildOf(joint, "axis"), "xyz", Vector3d::UnitX());
    if (axis.norm() < 1e-6) FailAt(joint, "joint '" + name + "' has an axis without direction");
    MjcfElement made = Made("joint");
    made.Set("name", name);
    if (type == "prismatic") made.Set("type", "slide");
    made.Set("axis", TextOf(axis));
    const MjcfElement* limit = ChildOf(joint, "limit");
    UrdfReadJoint read{.name = name,
                       .effort = NumberIn(limit, "effort", 0),
                       .velocity = NumberIn(limit, "velocity", 0),
                       .range = {}};
    if (type != "continuous") {
      const double lower = NumberIn(limit, "lower", 0), upper = NumberIn(limit, "upper", 0);
      if (lower < upper) {
        made.Set("range", TextOf(lower) + " " + TextOf(upper));
        read.range = {lower, upper};
      } else {
        robot_.notes.push_back("joint '" + name + "' has no range: it turns without end");
      }
    }
    const MjcfElement* dynamics = ChildOf(joint, "dynamics");
    const double damping = NumberIn(dynamics, "damping", 0);
    const double friction = NumberIn(dynamics, "friction", 0);
    if (damping > 0) made.Set("damping", TextOf(damping));
    if (friction > 0) made.Set("frictionloss", TextOf(friction));
    if (ChildOf(joint, "mimic") != nullptr) {
      robot_.notes.push_back("joint '" + name + "' mimics another: here it moves by itself");
    }
    robot_.joints.push_back(std::move(read));
    return made;
  }

  // Returns a geom like `at` for each part of a <visual> or <collision>.
  std::vector<MjcfElement> Shapes(const MjcfElement& of, bool looks, MjcfElement at) {
    const MjcfElement* geometry = ChildOf(of, "geometry");
    if (geometry == nullptr || geometry->children.empty())
      FailAt(of, "<" + of.name + "> has no shape");
    const MjcfElement& shape = geometry->children.front();
    if (shape.name == "mesh") return Mesh(shape, looks, at);
    at.Set("type", shape.name);
    if (shape.name == "box") {
      at.Set("size", TextOf(VectorIn(&shape, "size", Vector3d::Ones()) / 2));
    } else if (shape.name == "cylinder") {
      at.Set("size", TextOf(NumberIn(&shape, "radius", 1)) + " " +
                         TextOf(NumberIn(&shape, "length", 1) / 2));
    } else if (shape.name == "sphere") {
      at.Set("size", TextOf(NumberIn(&shape, "radius", 1)));
    } else {
      FailAt(shape,
             "<" + shape.name + "> is no shape of URDF; expected box, cylinder, sphere, mesh");
    }
    return {std::move(at)};
  }

  // Returns no geom for a mesh that is only looked at and cannot be read.
  std::vector<MjcfElement> Mesh(const MjcfElement& shape, bool looks, const MjcfElement& at) {
    std::vector<UrdfMeshes::Part> parts;
    try {
      parts = meshes_.Take(shape);
    } catch (const ModelError& error) {
      if (!looks) throw;
      robot_.notes.push_back(std::string(error.what()) + "; visual mesh skipped");
    }
    std::vector<MjcfElement> geoms;
    for (const UrdfMeshes::Part& part : parts) {
      MjcfElement& geom = geoms.emplace_back(at);
      geom.Set("type", "mesh");
      geom.Set("mesh", part.asset);
      if (looks && part.rgba) geom.Set("rgba", NumbersText(*part.rgba));
    }
    return geoms;
  }

  void Paint(const MjcfElement& visual, MjcfElement* geom) const {
    const MjcfElement* material = ChildOf(visual, "material");
    if (material == nullptr) return;
    const MjcfElement* color = ChildOf(*material, "color");
    const auto named = colors_.find(material->Get("name"));
    if (color == nullptr && named != colors_.end()) color = named->second;
    if (color == nullptr) return;
    geom->Set("rgba", NumbersText(NumbersIn(color, "rgba", {0.7, 0.7, 0.7, 1})));
  }

  // What stands before the bodies.
  void AddHead() {
    MjcfElement compiler = Made("compiler");
    compiler.Set("angle", "radian");
    compiler.Set("autolimits", "true");
    compiler.Set("inertiafromgeom", "false");
    robot_.model.children.push_back(std::move(compiler));
    MjcfElement defaults = Made("default");
    MjcfElement joint = Made("joint");
    joint.Set("armature", TextOf(kRotorInertia));
    defaults.children.push_back(std::move(joint));
    const auto add = [&](const std::string& name, const char* contype, const char* group) {
      MjcfElement one = Made("default"), geom = Made("geom");
      one.Set("class", name);
      geom.Set("contype", contype);
      geom.Set("conaffinity", "0");
      geom.Set("group", group);
      geom.Set("mass", "0");
      one.children.push_back(std::move(geom));
      defaults.children.push_back(std::move(one));
    };
    add("visual", "0", "2");
    add("collision", "1", "3");
    robot_.model.children.push_back(std::move(defaults));
    robot_.meshes = meshes_.TakeFiles();
    MjcfElement assets = Made("asset");
    assets.children = meshes_.TakeAssets();
    if (!assets.children.empty()) robot_.model.children.push_back(std::move(assets));
  }

  MjcfElement root_;
  std::map<std::string, const MjcfElement*> links_;
  std::map<std::string, const MjcfElement*> colors_;                 // by material
  std::map<std::string, std::vector<const MjcfElement*>> children_;  // joints, by parent link
  std::set<std::string> parents_;                                    // links that have one
  UrdfMeshes meshes_;
  UrdfRobot robot_;
};

}  // namespace

UrdfRobot ReadUrdf(const path& file, DaeUse dae) { return UrdfTree(file, dae).Read(); }

std::string IndentedMjcf(const MjcfElement& root, const std::string& comment) {
  tinyxml2::XMLDocument document;
  document.Parse(WriteMjcf(root).xml.c_str());
  document.RootElement()->InsertFirstChild(document.NewComment(comment.c_str()));
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

}  // namespace understudy::mjcf
