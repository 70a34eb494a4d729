#include "objects/object_bodies.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <mujoco/mujoco.h>

#include "base/errors.h"
#include "base/printed.h"
#include "objects/prints.h"
#include "objects/walk.h"

namespace understudy::objects {
namespace {

using mjcf::MjcfElement;

// MuJoCo's own defaults, and torsional friction 0.005 m, which condim 3 leaves out.
constexpr char kStiffness[] = "0.02 1", kImpedance[] = "0.9 0.95 0.001 0.5 2";
constexpr char kTorsional[] = "0.005";

std::string Numbers(std::span<const double> values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : " ") + Printed("%.9g", value);
  return text;
}

struct ShapeRow {
  const char* type;
  std::size_t sizes;  // that it has
  double (*volume)(const std::array<double, 3>& size);
};

// By PartShape.
constexpr double kPi = std::numbers::pi;
using Size = std::array<double, 3>;
constexpr ShapeRow kShapes[] = {
    {"box", 3, [](const Size& s) { return 8 * s[0] * s[1] * s[2]; }},
    {"sphere", 1, [](const Size& s) { return 4.0 / 3 * kPi * s[0] * s[0] * s[0]; }},
    {"cylinder", 2, [](const Size& s) { return 2 * kPi * s[0] * s[0] * s[1]; }},
    {"capsule", 2, [](const Size& s) { return kPi * s[0] * s[0] * (2 * s[1] + 4.0 / 3 * s[0]); }},
};

const ShapeRow& RowOf(const ObjectPart& part) {
  return kShapes[static_cast<std::size_t>(part.shape)];
}

double VolumeOf(const ObjectPart& part) { return RowOf(part).volume(part.size); }

MjcfElement Element(const std::string& name,
                    std::vector<std::pair<std::string, std::string>> attributes) {
  return {.name = name, .attributes = std::move(attributes), .children = {}, .place = {}};
}

// In a body whose origin is `origin` [m] over the underside. `mass` [kg] and `friction` are those
// of the object.
MjcfElement GeomOf(const ObjectPart& part, double origin, const ObjectKind& kind, double mass,
                   double friction) {
  double volume = 0;
  for (const ObjectPart& one : kind.parts) volume += VolumeOf(one);
  const ShapeRow& row = RowOf(part);
  std::array<double, 3> at = part.at;
  at[2] -= origin;
  const bool rolls = kind.rolling > 0;
  const char* const upright = "1 0 0 0";
  const char* const along_y = "0.70710678118654757 0.70710678118654757 0 0";
  return Element("geom", {{"type", row.type},
                          {"size", Numbers(std::span(part.size).first(row.sizes))},
                          {"pos", Numbers(at)},
                          {"quat", part.lies ? along_y : upright},
                          {"mass", Printed("%.9g", mass * VolumeOf(part) / volume)},
                          {"rgba", part.colour},
                          {"friction", Printed("%.9g", friction) + " " + kTorsional + " " +
                                           Printed("%.9g", rolls ? kind.rolling : 0.0001)},
                          {"condim", rolls ? "6" : "3"},
                          {"priority", "0"},
                          {"contype", "1"},
                          {"conaffinity", "1"},
                          {"group", "0"},
                          {"margin", "0"},
                          {"gap", "0"},
                          {"solmix", "1"},
                          {"solref", kStiffness},
                          {"solimp", kImpedance}});
}

// What MuJoCo asks of what is fixed, though it moves nothing; what walks hardly gives way.
constexpr double kMassOfFixed = 1, kMassOfWalker = 200;  // kg, *assumed*

double MassOf(const ObjectSpec& object) {
  if (Walks(object)) return kMassOfWalker;
  if (IsFixed(object)) return kMassOfFixed;
  return object.mass > 0 ? object.mass : KindOf(object).mass;
}

// Stands out by so little that nothing shows it, and by enough for a picture's depth.
constexpr double kInk = 0.0005;  // m, *assumed*

MjcfElement GeomOf(const Print& print, const ObjectKind& kind) {
  const ObjectPart& board = kind.parts.front();
  const std::array<double, 3> at{board.at[0] + board.size[0], print.at[0],
                                 print.at[1] - kind.height / 2};
  const std::array<double, 3> size{kInk, print.half[0], print.half[1]};
  return Element("geom", {{"type", "box"},
                          {"size", Numbers(size)},
                          {"pos", Numbers(at)},
                          {"quat", "1 0 0 0"},
                          {"mass", "0"},
                          {"rgba", "0 0 0 1"},
                          {"contype", "0"},
                          {"conaffinity", "0"},
                          {"group", "0"}});
}

bool ShowsPicture(const ObjectSpec& object) {
  return KindOf(object).print.pattern == Pattern::kPicture && !object.image.empty();
}

// A sheet before the board, whose left edge is on the left of who looks at it.
MjcfElement PictureOf(const ObjectKind& kind, const std::string& name) {
  const ObjectPart& board = kind.parts.front();
  const std::array<double, 3> at{board.at[0] + board.size[0] + kInk, board.at[1], 0};
  const std::array<double, 3> size{board.size[1], board.size[2], 1};
  return Element("geom", {{"type", "plane"},
                          {"size", Numbers(size)},
                          {"pos", Numbers(at)},
                          {"quat", "0.5 0.5 0.5 0.5"},
                          {"mass", "0"},
                          {"material", name + "/picture"},
                          {"rgba", "1 1 1 1"},
                          {"contype", "0"},
                          {"conaffinity", "0"},
                          {"group", "0"}});
}

bool HasLegs(const ObjectSpec& object) { return Walks(object) && KindOf(object).gait.step > 0; }

constexpr std::pair<Side, const char*> kLegs[] = {{Side::kLeft, "/left"}, {Side::kRight, "/right"}};

// Without its shapes; its origin is between the hips.
MjcfElement LegOf(const ObjectKind& kind, const std::string& name) {
  const std::array<double, 3> pos{0, 0, kind.gait.hips - kind.height / 2};
  MjcfElement leg = Element("body", {{"name", name}, {"pos", Numbers(pos)}});
  leg.children.push_back(Element("joint", {{"name", name},
                                           {"type", "hinge"},
                                           {"axis", "0 1 0"},
                                           {"pos", "0 0 0"},
                                           {"limited", "false"},
                                           {"ref", "0"},
                                           {"stiffness", "0"},
                                           {"damping", "0"},
                                           {"frictionloss", "0"},
                                           {"armature", "0"}}));
  return leg;
}

MjcfElement BodyOf(const ObjectSpec& object, const std::string& name, Prints prints) {
  const ObjectKind& kind = KindOf(object);
  WalkPose at{.x = object.pos[0], .y = object.pos[1], .yaw = object.yaw};
  if (Walks(object)) at = Walk(object).At(0);
  const std::array<double, 3> pos{at.x, at.y, object.pos[2] + kind.height / 2};
  const std::array<double, 4> turn{std::cos(at.yaw / 2), 0, 0, std::sin(at.yaw / 2)};
  MjcfElement body =
      Element("body", {{"name", name}, {"pos", Numbers(pos)}, {"quat", Numbers(turn)}});
  if (!IsFixed(object)) body.children.push_back(Element("freejoint", {{"name", name}}));
  const double mass = MassOf(object);
  const double friction = object.friction > 0 ? object.friction : kind.friction;
  for (const ObjectPart& part : kind.parts) {
    if (HasLegs(object) && part.swings != Side::kNeither) continue;
    body.children.push_back(GeomOf(part, kind.height / 2, kind, mass, friction));
  }
  for (const auto& [side, suffix] : kLegs) {
    if (!HasLegs(object)) break;
    MjcfElement& leg = body.children.emplace_back(LegOf(kind, name + suffix));
    for (const ObjectPart& part : kind.parts) {
      if (part.swings != side) continue;
      leg.children.push_back(GeomOf(part, kind.gait.hips, kind, mass, friction));
    }
  }
  if (prints == Prints::kKept) {
    for (const Print& print : PrintsOf(object)) body.children.push_back(GeomOf(print, kind));
    if (ShowsPicture(object)) body.children.push_back(PictureOf(kind, name));
  }
  return body;
}

}  // namespace

MjcfElement MakeObjectBodies(std::span<const ObjectSpec> objects, Prints prints) {
  MjcfElement world = Element("worldbody", {});
  const std::vector<std::string> names = NamesOf(objects);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    world.children.push_back(BodyOf(objects[i], names[i], prints));
  }
  return world;
}

void RequirePictures(std::span<const ObjectSpec> objects) {
  constexpr std::string_view kPngHead = "\x89PNG\r\n\x1a\n";
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const std::string& image = objects[i].image;
    if (image.empty()) continue;
    std::error_code error;
    std::string head(kPngHead.size(), '\0');
    if (std::filesystem::is_regular_file(image, error)) {
      std::ifstream file(image, std::ios::binary);
      file.read(head.data(), static_cast<std::streamsize>(head.size()));
    }
    if (head == kPngHead) continue;
    throw ModelError("objects." + std::to_string(i) + ".image: expected a PNG, got '" +
                     Printable(image) + "'");
  }
}

MjcfElement MakePictures(std::span<const ObjectSpec> objects) {
  MjcfElement asset = Element("asset", {});
  const std::vector<std::string> names = NamesOf(objects);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (!ShowsPicture(objects[i])) continue;
    const std::string name = names[i] + "/picture";
    const std::string file = std::filesystem::absolute(objects[i].image).string();
    asset.children.push_back(Element("texture", {{"name", name}, {"type", "2d"}, {"file", file}}));
    asset.children.push_back(Element("material", {{"name", name},
                                                  {"texture", name},
                                                  {"texuniform", "false"},
                                                  {"texrepeat", "1 1"},
                                                  {"specular", "0.1"},
                                                  {"shininess", "0.1"},
                                                  {"reflectance", "0"}}));
  }
  return asset;
}

namespace {

// Of those that walk: the object's and its legs'.
std::vector<std::string> BodyNamesOf(const ObjectSpec& object, const std::string& name) {
  std::vector<std::string> names{name};
  if (!HasLegs(object)) return names;
  for (const auto& [side, suffix] : kLegs) names.push_back(name + suffix);
  return names;
}

}  // namespace

MjcfElement MakeExclusions(std::span<const ObjectSpec> objects) {
  MjcfElement contact = Element("contact", {});
  const std::vector<std::string> names = NamesOf(objects);
  std::vector<std::string> others{"world"}, walkers;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (IsFixed(objects[i])) others.push_back(names[i]);
  }
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (!Walks(objects[i])) continue;
    for (const std::string& body : BodyNamesOf(objects[i], names[i])) {
      for (const std::string& other : others) {
        contact.children.push_back(Element("exclude", {{"body1", other}, {"body2", body}}));
      }
      walkers.push_back(body);
    }
    others.insert(others.end(), walkers.begin(), walkers.end());
    walkers.clear();
  }
  return contact;
}

void RequireOwnNames(std::span<const ObjectSpec> objects, const mjModel& model,
                     const std::filesystem::path& file) {
  const std::vector<std::string> names = NamesOf(objects);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (mj_name2id(&model, mjOBJ_BODY, names[i].c_str()) < 0) continue;
    throw ModelError("objects." + std::to_string(i) + ".name: " + file.string() + " has a body '" +
                     names[i] + "' of its own; expected another name");
  }
}

}  // namespace understudy::objects
