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

enum class Side : std::uint8_t { kNeither, kLeft, kRight };

// A shape of an object that stands in the origin and looks along +x.
struct ObjectPart {
  PartShape shape;
  std::array<double, 3> at;      // m: its middle, from the middle of the object's underside
  std::array<double, 3> size;    // m: half sides; else radius and half length, of a capsule without
                                 // its ends
  const char* colour;            // red, green, blue, opacity from 0 to 1
  bool lies = false;             // a cylinder or capsule whose axis is y in place of z
  Side swings = Side::kNeither;  // as a leg of that side, while the object walks
};

enum class Pattern : std::uint8_t { kNone, kAprilTag, kCheckers, kPicture };

// How legs swing: as a pendulum about the hips that takes a foot half a step ahead and behind.
struct GaitSpec {
  double hips = 0;  // m over the underside
  double step = 0;  // m; 0: it has no legs
};

// What is printed on an object's front, in its middle; cameras alone see it (objects/prints.h).
struct PrintSpec {
  Pattern pattern = Pattern::kNone;
  double cell = 0;  // m, side of a cell or a square
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
  double speed = 0;  // m/s along a path; 0: the object has to say
  PrintSpec print{};
  GaitSpec gait{};

  bool fixed() const { return mass == 0; }
};

// A corner of a path.
struct Corner {
  std::array<double, 2> to{};  // m, world
  double wait = 0;             // s that it stands there, each time
};

// What happens at the last corner.
enum class PathEnd : std::uint8_t {
  kBack,   // it goes back the way it came, and begins again
  kRound,  // it goes straight to where it began, and begins again
  kStay,   // it stays there
};

// One object. Each field is a YAML key of the same name (config/terrain_keys.cc).
struct ObjectSpec {
  std::string kind = "cube";
  std::string name{};           // ""; see NamesOf
  std::array<double, 3> pos{};  // m, world: the middle of its underside
  double yaw = 0;               // rad
  double mass = 0;              // kg; 0: the kind's
  double friction = 0;          // 0: the kind's
  // The corners that it walks to from `pos` on (objects/walk.h); none: it does not walk.
  std::vector<Corner> path{};
  double speed = 0;  // m/s; 0: the kind's
  double wait = 0;   // s that it stands at `pos`, each time
  PathEnd then = PathEnd::kBack;
  int id = 0;           // of an AprilTag
  std::string image{};  // PNG, of a poster
  int seed = 0;         // draws where on its way it begins; 0: at `pos`
};

// The most objects of a world; *assumed*. Room for contacts is reserved for each.
inline constexpr std::size_t kMostObjects = 32;
// The most corners of a path; *assumed*.
inline constexpr std::size_t kMostCorners = 64;

// Returns all rows, in the order of the documentation.
std::span<const ObjectKind> ObjectKinds();
const std::vector<std::string>& ObjectKindNames();

// Returns the row of that name, which there must be.
const ObjectKind& KindOf(const ObjectSpec& object);

// Whether it walks along a path, and whether it neither walks nor can be moved.
bool Walks(const ObjectSpec& object);
bool IsFixed(const ObjectSpec& object);

// Returns the speed [m/s] at which it walks; 0 if neither it nor its kind has one.
double SpeedOf(const ObjectSpec& object);

// Returns the name of each: its own, or its kind's, with a number from the second of a kind on.
std::vector<std::string> NamesOf(std::span<const ObjectSpec> objects);

// Returns the names of those that move.
std::vector<std::string> MovingNamesOf(std::span<const ObjectSpec> objects);

}  // namespace understudy::objects
