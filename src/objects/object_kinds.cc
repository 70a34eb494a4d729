#include "objects/object_kinds.h"

#include <algorithm>
#include <cassert>
#include <map>

namespace understudy::objects {
namespace {

using enum PartShape;
using enum Side;

// All sizes, masses and colours are assumed, such as shops sell, but for those whose row says more.
constexpr const char* kOak = "0.62 0.45 0.29 1";
constexpr const char* kPine = "0.8 0.66 0.46 1";
constexpr const char* kRed = "0.78 0.2 0.16 1";
constexpr const char* kBlue = "0.2 0.42 0.66 1";
constexpr const char* kWhite = "0.92 0.92 0.9 1";
constexpr const char* kGreen = "0.24 0.5 0.36 1";
constexpr const char* kCardboard = "0.7 0.55 0.38 1";
constexpr const char* kDark = "0.16 0.17 0.19 1";
constexpr const char* kOrange = "0.9 0.5 0.15 1";
constexpr const char* kPaper = "1 1 1 1";
constexpr const char* kSkin = "0.8 0.62 0.5 1";
constexpr bool kLies = true;

constexpr ObjectPart kCube[] = {{kBox, {0, 0, 0.025}, {0.025, 0.025, 0.025}, kRed}};
constexpr ObjectPart kBall[] = {{kSphere, {0, 0, 0.11}, {0.11}, kOrange}};
constexpr ObjectPart kBottle[] = {{kCylinder, {0, 0, 0.07}, {0.032, 0.07}, kGreen},
                                  {kCylinder, {0, 0, 0.17}, {0.014, 0.03}, kGreen}};
// Solid: nothing can be put into it.
constexpr ObjectPart kCup[] = {{kCylinder, {0, 0, 0.0475}, {0.04, 0.0475}, kBlue},
                               {kBox, {0.06, 0, 0.0475}, {0.006, 0.007, 0.032}, kBlue},
                               {kBox, {0.048, 0, 0.0735}, {0.012, 0.007, 0.006}, kBlue},
                               {kBox, {0.048, 0, 0.0215}, {0.012, 0.007, 0.006}, kBlue}};
constexpr ObjectPart kHandled[] = {{kBox, {0, 0, 0.125}, {0.15, 0.19, 0.125}, kCardboard},
                                   {kCapsule, {0.2, 0, 0.17}, {0.012, 0.06}, kDark, kLies},
                                   {kCapsule, {-0.2, 0, 0.17}, {0.012, 0.06}, kDark, kLies},
                                   {kBox, {0.175, 0.06, 0.17}, {0.025, 0.008, 0.008}, kDark},
                                   {kBox, {0.175, -0.06, 0.17}, {0.025, 0.008, 0.008}, kDark},
                                   {kBox, {-0.175, 0.06, 0.17}, {0.025, 0.008, 0.008}, kDark},
                                   {kBox, {-0.175, -0.06, 0.17}, {0.025, 0.008, 0.008}, kDark}};
constexpr ObjectPart kCrate[] = {{kBox, {0, 0, 0.3}, {0.2, 0.2, 0.3}, kCardboard}};
// Round feet: each meets the floor in one point.
constexpr ObjectPart kChair[] = {{kBox, {0, 0, 0.445}, {0.21, 0.21, 0.015}, kPine},
                                 {kBox, {-0.2, 0, 0.75}, {0.015, 0.2, 0.15}, kPine},
                                 {kCapsule, {0.18, 0.18, 0.215}, {0.02, 0.195}, kPine},
                                 {kCapsule, {0.18, -0.18, 0.215}, {0.02, 0.195}, kPine},
                                 {kCapsule, {-0.2, 0.18, 0.45}, {0.02, 0.43}, kPine},
                                 {kCapsule, {-0.2, -0.18, 0.45}, {0.02, 0.43}, kPine}};
constexpr ObjectPart kTable[] = {{kBox, {0, 0, 0.73}, {0.35, 0.6, 0.02}, kOak},
                                 {kBox, {0.31, 0.56, 0.355}, {0.025, 0.025, 0.355}, kOak},
                                 {kBox, {0.31, -0.56, 0.355}, {0.025, 0.025, 0.355}, kOak},
                                 {kBox, {-0.31, 0.56, 0.355}, {0.025, 0.025, 0.355}, kOak},
                                 {kBox, {-0.31, -0.56, 0.355}, {0.025, 0.025, 0.355}, kOak}};
constexpr ObjectPart kPedestal[] = {{kBox, {0, 0, 0.4}, {0.15, 0.15, 0.4}, kWhite}};

constexpr ObjectPart kPerson[] = {
    {kCapsule, {0, 0.09, 0.43}, {0.075, 0.355}, kDark, !kLies, kLeft},
    {kCapsule, {0, -0.09, 0.43}, {0.075, 0.355}, kDark, !kLies, kRight},
    {kBox, {0, 0, 1.14}, {0.11, 0.18, 0.3}, kRed},
    {kCapsule, {0, 0.23, 1.11}, {0.045, 0.265}, kRed},
    {kCapsule, {0, -0.23, 1.11}, {0.045, 0.265}, kRed},
    {kCylinder, {0, 0, 1.48}, {0.05, 0.05}, kSkin},
    {kSphere, {0, 0, 1.635}, {0.115}, kSkin}};
constexpr ObjectPart kChild[] = {{kCapsule, {0, 0.065, 0.29}, {0.06, 0.23}, kDark, !kLies, kLeft},
                                 {kCapsule, {0, -0.065, 0.29}, {0.06, 0.23}, kDark, !kLies, kRight},
                                 {kBox, {0, 0, 0.76}, {0.08, 0.13, 0.2}, kBlue},
                                 {kCapsule, {0, 0.165, 0.76}, {0.035, 0.17}, kBlue},
                                 {kCapsule, {0, -0.165, 0.76}, {0.035, 0.17}, kBlue},
                                 {kCylinder, {0, 0, 0.98}, {0.035, 0.04}, kSkin},
                                 {kSphere, {0, 0, 1.1}, {0.1}, kSkin}};
// Its handle is behind.
constexpr ObjectPart kCart[] = {{kCylinder, {0.36, 0.24, 0.08}, {0.08, 0.02}, kDark, kLies},
                                {kCylinder, {0.36, -0.24, 0.08}, {0.08, 0.02}, kDark, kLies},
                                {kCylinder, {-0.36, 0.24, 0.08}, {0.08, 0.02}, kDark, kLies},
                                {kCylinder, {-0.36, -0.24, 0.08}, {0.08, 0.02}, kDark, kLies},
                                {kBox, {0, 0, 0.19}, {0.45, 0.3, 0.03}, kBlue},
                                {kBox, {0.05, 0, 0.47}, {0.35, 0.26, 0.25}, kCardboard},
                                {kCylinder, {-0.43, 0.27, 0.6}, {0.015, 0.4}, kDark},
                                {kCylinder, {-0.43, -0.27, 0.6}, {0.015, 0.4}, kDark},
                                {kCapsule, {-0.43, 0, 0.985}, {0.015, 0.27}, kDark, kLies}};

constexpr ObjectPart kTag[] = {{kBox, {0, 0, 0.1}, {0.005, 0.1, 0.1}, kPaper}};
// A1.
constexpr ObjectPart kPoster[] = {{kBox, {0, 0, 0.4205}, {0.005, 0.297, 0.4205}, kPaper}};
constexpr ObjectPart kBoard[] = {{kBox, {0, 0, 0.12}, {0.005, 0.15, 0.12}, kPaper}};

constexpr GaitSpec kPersonsGait{.hips = 0.82, .step = 0.7};
constexpr GaitSpec kChildsGait{.hips = 0.56, .step = 0.5};
constexpr PrintSpec kPlain{};
constexpr PrintSpec kTagPrint{.pattern = Pattern::kAprilTag, .cell = 0.02};
constexpr PrintSpec kBoardPrint{.pattern = Pattern::kCheckers, .cell = 0.03};
constexpr PrintSpec kPicture{.pattern = Pattern::kPicture};

constexpr double kFixed = 0, kStays = 0;
constexpr ObjectKind kKinds[] = {
    {"cube", "A cube of 5 cm", 0.05, 0.1, 0.6, kStays, "assumed", kCube},
    {"ball", "A football of size 5, 22 cm across", 0.22, 0.43, 0.6, 0.005,
     "size, mass: IFAB, Laws of the Game, law 2; rest assumed", kBall},
    {"bottle", "A bottle of 20 cm, 6.4 cm across", 0.2, 0.3, 0.6, kStays, "assumed", kBottle},
    {"cup", "A cup with a handle, 8 cm across, solid", 0.095, 0.35, 0.6, kStays, "assumed", kCup},
    {"box", "A box of 30 × 38 × 25 cm with handles before and behind", 0.25, 2, 0.6, kStays,
     "assumed", kHandled},
    {"crate", "A high box of 40 × 40 × 60 cm, to be pushed over", 0.6, 3, 0.6, kStays, "assumed",
     kCrate},
    {"chair", "A chair with its seat 46 cm high", 0.9, 5, 0.6, kStays, "assumed", kChair},
    {"table", "A table of 70 × 120 cm, 75 cm high", 0.75, kFixed, 0.6, kStays, "assumed", kTable},
    {"pedestal", "A pedestal of 30 × 30 cm, 80 cm high", 0.8, kFixed, 0.6, kStays, "assumed",
     kPedestal},
    {"person", "A person, 50 cm wide", 1.75, kFixed, 0.6, kStays,
     "speed: Bohannon, Age and Ageing 26 (1997), comfortable gait of adults; rest assumed", kPerson,
     1.4, kPlain, kPersonsGait},
    {"child", "A child, 40 cm wide", 1.2, kFixed, 0.6, kStays, "assumed", kChild, 1, kPlain,
     kChildsGait},
    {"cart", "A cart of 90 × 60 cm with boxes, its handle behind", 1, kFixed, 0.6, kStays,
     "assumed", kCart, 0.8},
    {"tag", "An AprilTag of 36h11, 16 cm, on a board of 20 cm", 0.2, kFixed, 0.6, kStays,
     "pattern: AprilRobotics/apriltag; rest assumed", kTag, 0, kTagPrint},
    {"checkerboard", "A checkerboard of 9 × 7 squares of 3 cm, on a board of 30 × 24 cm", 0.24,
     kFixed, 0.6, kStays, "assumed", kBoard, 0, kBoardPrint},
    {"poster", "A poster of A1, 59 × 84 cm, with a picture of your own", 0.841, kFixed, 0.6, kStays,
     "size: ISO 216; rest assumed", kPoster, 0, kPicture},
};

}  // namespace

std::span<const ObjectKind> ObjectKinds() { return kKinds; }

const std::vector<std::string>& ObjectKindNames() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names;
    for (const ObjectKind& kind : kKinds) names.emplace_back(kind.name);
    return names;
  }();
  return kNames;
}

const ObjectKind& KindOf(const ObjectSpec& object) {
  const auto* const found = std::ranges::find(kKinds, object.kind, &ObjectKind::name);
  assert(found != std::end(kKinds));
  return *found;
}

bool Walks(const ObjectSpec& object) { return !object.path.empty(); }

bool IsFixed(const ObjectSpec& object) { return KindOf(object).fixed() && !Walks(object); }

double SpeedOf(const ObjectSpec& object) {
  return object.speed > 0 ? object.speed : KindOf(object).speed;
}

std::vector<std::string> NamesOf(std::span<const ObjectSpec> objects) {
  std::vector<std::string> names;
  std::map<std::string, int> counts;
  for (const ObjectSpec& object : objects) {
    const int count = ++counts[object.kind];
    const std::string number = count == 1 ? "" : "_" + std::to_string(count);
    names.push_back(object.name.empty() ? object.kind + number : object.name);
  }
  return names;
}

std::vector<std::string> MovingNamesOf(std::span<const ObjectSpec> objects) {
  std::vector<std::string> names = NamesOf(objects), moving;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (!IsFixed(objects[i])) moving.push_back(std::move(names[i]));
  }
  return moving;
}

}  // namespace understudy::objects
