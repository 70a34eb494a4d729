#include "objects/object_bodies.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <mujoco/mujoco.h>

#include "base/errors.h"
#include "base/printed.h"

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

// `mass` [kg] and `friction` are those of the object.
MjcfElement GeomOf(const ObjectPart& part, const ObjectKind& kind, double mass, double friction) {
  double volume = 0;
  for (const ObjectPart& one : kind.parts) volume += VolumeOf(one);
  const ShapeRow& row = RowOf(part);
  std::array<double, 3> at = part.at;
  at[2] -= kind.height / 2;
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

MjcfElement BodyOf(const ObjectSpec& object, const std::string& name) {
  const ObjectKind& kind = KindOf(object);
  const std::array<double, 3> at{object.pos[0], object.pos[1], object.pos[2] + kind.height / 2};
  const std::array<double, 4> turn{std::cos(object.yaw / 2), 0, 0, std::sin(object.yaw / 2)};
  MjcfElement body =
      Element("body", {{"name", name}, {"pos", Numbers(at)}, {"quat", Numbers(turn)}});
  if (!kind.fixed()) body.children.push_back(Element("freejoint", {{"name", name}}));
  double mass = object.mass > 0 ? object.mass : kind.mass;
  if (kind.fixed()) mass = 1;  // kg: MuJoCo asks for some, though it moves nothing
  const double friction = object.friction > 0 ? object.friction : kind.friction;
  for (const ObjectPart& part : kind.parts) {
    body.children.push_back(GeomOf(part, kind, mass, friction));
  }
  return body;
}

}  // namespace

MjcfElement MakeObjectBodies(std::span<const ObjectSpec> objects) {
  MjcfElement world = Element("worldbody", {});
  const std::vector<std::string> names = NamesOf(objects);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    world.children.push_back(BodyOf(objects[i], names[i]));
  }
  return world;
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
