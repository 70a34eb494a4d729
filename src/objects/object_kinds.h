// The kinds of objects that a world may hold.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::objects {

enum class PartShape : std::uint8_t { kBox, kSphere, kCylinder, kCapsule };

// A shape of an object that stands in the origin and looks along +x.
struct ObjectPart {
  PartShape shape;
  std::array<double, 3> at;    // m: its middle, from the middle of the object's underside
  std::array<double, 3> size;  // m: half sides; else radius and half length, of a capsule without
                               // its ends
  const char* colour;          // red, green, blue, opacity from 0 to 1
  bool lies = false;           // a cylinder or capsule whose axis is y in place of z
};

// A row: sizes are those of its parts.
struct ObjectKind {
  std::string_view name;
  std::string_view does;  // for the documentation
  double height;          // m
  double mass;            // kg, spread evenly over the parts' volumes; 0: it is fixed to the world
  double friction;        // sliding
  double rolling;         // m, coefficient of rolling friction; 0: nothing holds back what rolls
  std::string_view source;
  std::span<const ObjectPart> parts;

  bool fixed() const { return mass == 0; }
};

// One object. Each field is a YAML key of the same name (config/terrain_keys.cc).
struct ObjectSpec {
  std::string kind = "cube";
  std::string name{};           // ""; see NamesOf
  std::array<double, 3> pos{};  // m, world: the middle of its underside
  double yaw = 0;               // rad
  double mass = 0;              // kg; 0: the kind's
  double friction = 0;          // 0: the kind's
};

// The most objects of a world; *assumed*. Room for contacts is reserved for each.
inline constexpr std::size_t kMostObjects = 32;

// Returns all rows, in the order of the documentation.
std::span<const ObjectKind> ObjectKinds();
const std::vector<std::string>& ObjectKindNames();

// Returns the row of that name, which there must be.
const ObjectKind& KindOf(const ObjectSpec& object);

// Returns the name of each: its own, or its kind's, with a number from the second of a kind on.
std::vector<std::string> NamesOf(std::span<const ObjectSpec> objects);

// Returns the names of those that can move.
std::vector<std::string> MovingNamesOf(std::span<const ObjectSpec> objects);

}  // namespace understudy::objects
