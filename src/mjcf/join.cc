#include "mjcf/join.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <span>
#include <string_view>
#include <utility>

#include <mujoco/mujoco.h>

#include "base/errors.h"
#include "mjcf/joints.h"

namespace understudy::mjcf {
namespace {

// Attributes that refer to a name in the model.
constexpr std::string_view kNames[] = {
    "name",     "class",    "childclass", "joint",      "joint1",   "joint2",   "body",
    "body1",    "body2",    "site",       "site1",      "site2",    "geom",     "geom1",
    "geom2",    "mesh",     "material",   "texture",    "hfield",   "tendon",   "tendon1",
    "tendon2",  "actuator", "camera",     "target",     "objname",  "refname",  "refsite",
    "sidesite", "instance", "cranksite",  "slidersite", "subtree1", "subtree2", "jointinparent"};
constexpr std::string_view kWorld = "world";  // the body that all robots share

// Sections without names. In <visual> `joint` and `camera` are colours and sizes.
constexpr std::string_view kNameless[] = {"visual", "option", "compiler", "size", "statistic"};

// Attributes that decide how a file is read, and MuJoCo's defaults. Without autolimits, which
// SpellOutLimits handles.
constexpr std::pair<const char*, const char*> kReading[] = {
    {"angle", "degree"},         {"coordinate", "local"},     {"eulerseq", "xyz"},
    {"inertiafromgeom", "auto"}, {"balanceinertia", "false"}, {"inertiagrouprange", "0 5"},
    {"boundmass", "0"},          {"boundinertia", "0"},       {"settotalmass", "-1"},
    {"fusestatic", "false"},     {"discardvisual", "false"},  {"fitaabb", "false"}};

constexpr bool kAutolimits = mjVERSION_HEADER >= 300;  // MuJoCo's own default

bool IsAnyOf(std::span<const std::string_view> words, const std::string& word) {
  return std::ranges::find(words, word) != words.end();
}

void SetIfMissing(const std::string& attribute, const std::string& value, MjcfElement* element) {
  if (element->Find(attribute) == nullptr) element->Set(attribute, value);
}

MjcfElement& ChildAtFront(const std::string& name, MjcfElement* parent) {
  auto child = std::ranges::find(parent->children, name, &MjcfElement::name);
  if (child == parent->children.end()) {
    child = parent->children.insert(
        parent->children.begin(),
        {.name = name, .attributes = {}, .children = {}, .place = parent->place});
  }
  return *child;
}

// In a file without autolimits, elements have no limits by default. The same in the topmost class
// of defaults also applies with autolimits.
void SpellOutLimits(MjcfElement* topmost) {
  SetIfMissing("limited", "false", &ChildAtFront("joint", topmost));
  SetIfMissing("limited", "false", &ChildAtFront("tendon", topmost));
  for (const char* of_actuator : {"ctrllimited", "forcelimited", "actlimited"}) {
    SetIfMissing(of_actuator, "false", &ChildAtFront("general", topmost));
  }
}

// Names the topmost class of defaults in every element that uses it implicitly.
void NameTopmostClass(const std::string& name, MjcfElement* root) {
  for (MjcfElement& section : root->children) {
    for (MjcfElement& child : section.children) {
      const std::string& kind = child.name;
      if (section.name == "worldbody") {
        SetIfMissing(kind == "body" || kind == "frame" ? "childclass" : "class", name, &child);
      }
      const bool takes_class = section.name == "equality" || section.name == "tendon" ||
                               section.name == "actuator" || kind == "mesh" || kind == "material" ||
                               kind == "pair";
      if (takes_class) SetIfMissing("class", name, &child);
    }
  }
}

// Nests the topmost class of defaults in a new, empty one.
void NestDefaults(MjcfElement* root) {
  MjcfElement nested{.name = "default", .attributes = {}, .children = {}, .place = root->place};
  std::string name = "main";  // MuJoCo's own name for it
  for (MjcfElement& section : root->children) {
    if (section.name != "default") continue;
    if (section.Find("class") != nullptr) name = section.Get("class");
    std::ranges::move(section.children, std::back_inserter(nested.children));
  }
  std::erase_if(root->children, [](const MjcfElement& e) { return e.name == "default"; });
  nested.Set("class", name);
  const std::string autolimits = CompilerSays(*root, "autolimits");
  if (autolimits == "false" || (autolimits.empty() && !kAutolimits)) SpellOutLimits(&nested);
  NameTopmostClass(name, root);
  ChildAtFront("default", root).children.push_back(std::move(nested));
}

void Prepend(const std::string& prefix, std::string* name) {
  if (!name->empty()) name->insert(0, prefix);
}

void PrefixNames(const std::string& prefix, MjcfElement* element) {
  const bool is_asset =
      element->name == "mesh" || element->name == "hfield" || element->name == "texture";
  if (is_asset && element->Find("file") != nullptr) {  // MuJoCo names it after its file
    SetIfMissing("name", std::filesystem::path(element->Get("file")).stem().string(), element);
  }
  for (auto& [attribute, value] : element->attributes) {
    if (IsAnyOf(kNames, attribute) && value != kWorld) Prepend(prefix, &value);
  }
  for (MjcfElement& child : element->children) {
    if (!IsAnyOf(kNameless, child.name)) PrefixNames(prefix, &child);
  }
}

void RequireSameReading(const MjcfElement& other, const MjcfElement& root) {
  for (const auto& [attribute, by_default] : kReading) {
    // Clang 14 has no structured bindings in lambdas.
    const auto value = [&, name = attribute, unsaid = by_default](const MjcfElement& of) {
      const std::string said = CompilerSays(of, name);
      return said.empty() ? unsaid : said;
    };
    if (value(other) == value(root)) continue;
    throw ModelError(other.place.text() + ": <compiler> " + attribute + "=\"" + value(other) +
                     "\" cannot be joined with \"" + value(root) + "\" of " + root.place.file);
  }
}

// Returns the attributes of an <option> element that `root`'s do not have.
void NoteOptions(const MjcfElement& option, const MjcfElement& root,
                 std::vector<std::string>* warnings) {
  for (const auto& [attribute, value] : option.attributes) {
    const bool same =
        attribute == "timestep" ||
        std::ranges::any_of(root.children,
                            [&, &name = attribute, &said = value](const MjcfElement& section) {
                              return section.name == "option" && section.Get(name) == said;
                            });
    if (same) continue;
    warnings->push_back(option.place.text() + ": <option> " + attribute + "=\"" + value +
                        "\" is left out: the options of " + root.place.file +
                        " hold for all robots");
  }
}

}  // namespace

void AddPrefix(const std::string& prefix, MjcfElement* root) {
  std::erase_if(root->children, [](const MjcfElement& e) { return e.name == "keyframe"; });
  NestDefaults(root);
  for (MjcfElement& section : root->children) {
    if (!IsAnyOf(kNameless, section.name)) PrefixNames(prefix, &section);
    if (section.name == "compiler") section.Set("autolimits", "true");
  }
}

robot::RobotSpec WithPrefix(const std::string& prefix, robot::RobotSpec spec) {
  for (std::string* name : {&spec.base_body, &spec.crane_body, &spec.imu.site,
                            &spec.imu.secondary_site, &spec.lidar.body}) {
    Prepend(prefix, name);
  }
  for (robot::CameraSpec& camera : spec.cameras) Prepend(prefix, &camera.body);
  for (std::string& joint : spec.locked_joints) Prepend(prefix, &joint);
  for (robot::BodySpec& body : spec.bodies) Prepend(prefix, &body.name);
  for (robot::SiteSpec& site : spec.sites) Prepend(prefix, &site.name);
  for (robot::MotorSpec* motor : robot::AllMotors(spec)) Prepend(prefix, &motor->joint);
  for (robot::HandSpec& hand : spec.hands) {
    for (robot::PadSpec& pad : hand.pads) Prepend(prefix, &pad.site);
  }
  for (robot::FootSpec& foot : spec.feet) {
    Prepend(prefix, &foot.name);  // joints of its side begin with it (physics/feet.h)
    for (std::string& geom : foot.geoms) Prepend(prefix, &geom);
  }
  return spec;
}

void MoveBodies(double x, double y, MjcfElement* root) {
  if (x == 0 && y == 0) return;
  for (MjcfElement& section : root->children) {
    if (section.name != "worldbody") continue;
    for (MjcfElement& body : section.children) {
      if (body.name != "body") continue;
      std::vector<double> p = {0, 0, 0};
      if (const std::string* pos = body.Find("pos")) {
        p = ReadNumbers({.attribute = "pos", .value = *pos, .place = body.place}, "pos", 3);
      }
      p[0] += x;
      p[1] += y;
      body.Set("pos", NumbersText(p));
    }
  }
}

void Join(MjcfElement other, MjcfElement* root, std::vector<std::string>* warnings) {
  RequireSameReading(other, *root);
  for (MjcfElement& section : other.children) {
    if (section.name == "compiler") continue;
    if (section.name == "option") {
      NoteOptions(section, *root, warnings);
      for (const MjcfElement& flags : section.children) NoteOptions(flags, *root, warnings);
    } else {
      root->children.push_back(std::move(section));
    }
  }
}

}  // namespace understudy::mjcf
