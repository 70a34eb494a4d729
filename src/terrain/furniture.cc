#include "terrain/furniture.h"

#include <algorithm>
#include <cmath>

namespace understudy::terrain {
namespace {

// All sizes of this file are assumed: such as shops sell.
constexpr double kWallHalf = 0.06;  // m, half the thickness of a wall
// MuJoCo looks closer at every geom whose sphere meets another's: long walls would slow each step.
constexpr double kPanel = 3;                            // m, a wall's longest part
constexpr double kLintel = 2.1;                         // m, the top of an opening
constexpr double kLayer = 0.004;                        // m between sheets
constexpr double kStartHalfX = 1.5, kStartHalfY = 0.9;  // m around the origin, kept free
constexpr double kBeforeOpening = 0.7;                  // m, kept free

constexpr auto kRound = PieceShape::kCylinder;
constexpr auto kSquare = PieceShape::kBox;
constexpr bool kSeen = false;  // and not touched, where the tick would pay for what nobody meets
constexpr const char* kOak = "0.62 0.45 0.29 1";
constexpr const char* kPine = "0.8 0.66 0.46 1";
constexpr const char* kWalnut = "0.38 0.26 0.18 1";
constexpr const char* kWhite = "0.92 0.92 0.9 1";
constexpr const char* kSteel = "0.62 0.64 0.66 1";
constexpr const char* kDark = "0.16 0.17 0.19 1";
constexpr const char* kLeaf = "0.25 0.45 0.22 1";
constexpr const char* kTeal = "0.2 0.42 0.45 1";
constexpr const char* kLinen = "0.86 0.82 0.74 1";
constexpr const char* kBlue = "0.18 0.32 0.55 1";
constexpr const char* kOrange = "0.9 0.45 0.12 1";
constexpr const char* kYellow = "0.93 0.75 0.12 1";
constexpr const char* kRed = "0.66 0.16 0.14 1";
constexpr const char* kClay = "0.68 0.4 0.28 1";
constexpr const char* kBrick = "0.64 0.42 0.34 1";
constexpr const char* kGlass = "0.45 0.58 0.68 1";

constexpr Part kTableParts[] = {{0, 0, 0.4, 0.7, 0.71, 0.75, kOak},
                                {0.34, 0.64, 0.03, 0.03, 0, 0.71, kOak},
                                {0.34, -0.64, 0.03, 0.03, 0, 0.71, kOak},
                                {-0.34, 0.64, 0.03, 0.03, 0, 0.71, kOak},
                                {-0.34, -0.64, 0.03, 0.03, 0, 0.71, kOak}};
constexpr Part kLowTableParts[] = {{0, 0, 0.28, 0.5, 0.38, 0.42, kWalnut},
                                   {0, 0.4, 0.24, 0.03, 0, 0.38, kWalnut},
                                   {0, -0.4, 0.24, 0.03, 0, 0.38, kWalnut}};
constexpr Part kChairParts[] = {
    {0, 0, 0.21, 0.21, 0.43, 0.46, kPine},    {-0.2, 0, 0.015, 0.21, 0.6, 0.9, kPine},
    {0.18, 0.18, 0.02, 0.02, 0, 0.43, kPine}, {0.18, -0.18, 0.02, 0.02, 0, 0.43, kPine},
    {-0.2, 0.18, 0.02, 0.02, 0, 0.9, kPine},  {-0.2, -0.18, 0.02, 0.02, 0, 0.9, kPine}};
constexpr Part kOfficeChairParts[] = {{0, 0, 0.23, 0.24, 0.42, 0.5, kDark},
                                      {-0.23, 0, 0.03, 0.22, 0.55, 1.05, kDark},
                                      {0, 0, 0.03, 0, 0.08, 0.42, kSteel, kRound},
                                      {0, 0, 0.28, 0, 0.02, 0.08, kDark, kRound}};
constexpr Part kSofaParts[] = {{0.05, 0, 0.4, 0.8, 0.06, 0.42, kTeal},
                               {-0.38, 0, 0.1, 1, 0.06, 0.82, kTeal},
                               {0.03, 0.9, 0.45, 0.1, 0.06, 0.6, kTeal},
                               {0.03, -0.9, 0.45, 0.1, 0.06, 0.6, kTeal},
                               {-0.22, 0.5, 0.08, 0.2, 0.42, 0.7, kYellow, kSquare, kSeen}};
constexpr Part kBedParts[] = {{0, 0, 1, 0.8, 0.05, 0.3, kOak},
                              {0.02, 0, 0.98, 0.78, 0.3, 0.5, kWhite},
                              {0.3, 0, 0.71, 0.81, 0.3, 0.54, kBlue, kSquare, kSeen},
                              {-1.02, 0, 0.03, 0.85, 0, 0.95, kOak},
                              {-0.72, 0.38, 0.2, 0.3, 0.5, 0.6, kLinen, kSquare, kSeen},
                              {-0.72, -0.38, 0.2, 0.3, 0.5, 0.6, kLinen, kSquare, kSeen}};
constexpr Part kDeskParts[] = {{0, 0, 0.4, 0.8, 0.7, 0.74, kPine},
                               {0, 0.77, 0.38, 0.02, 0, 0.7, kSteel},
                               {0, -0.77, 0.38, 0.02, 0, 0.7, kSteel},
                               {-0.2, 0, 0.015, 0.3, 0.84, 1.2, kDark},
                               {-0.2, 0, 0.1, 0.12, 0.74, 0.84, kDark, kSquare, kSeen}};
constexpr Part kBookshelfParts[] = {{-0.14, 0, 0.01, 0.5, 0, 1.9, kOak},
                                    {0, 0.49, 0.15, 0.015, 0, 1.9, kOak},
                                    {0, -0.49, 0.15, 0.015, 0, 1.9, kOak},
                                    {0, 0, 0.15, 0.5, 0.04, 0.07, kOak},
                                    {0, 0, 0.15, 0.5, 0.64, 0.67, kOak},
                                    {0, 0, 0.15, 0.5, 1.24, 1.27, kOak},
                                    {0, 0, 0.15, 0.5, 1.87, 1.9, kOak},
                                    {-0.01, 0.28, 0.11, 0.18, 0.07, 0.34, kRed, kSquare, kSeen},
                                    {-0.01, -0.2, 0.11, 0.26, 0.07, 0.38, kBlue, kSquare, kSeen},
                                    {-0.01, 0.1, 0.11, 0.35, 0.67, 0.93, kLinen, kSquare, kSeen},
                                    {-0.01, -0.3, 0.11, 0.16, 1.27, 1.55, kClay, kSquare, kSeen}};
constexpr Part kWardrobeParts[] = {{0, 0, 0.3, 0.75, 0, 2.1, kWhite},
                                   {0.31, 0.06, 0.015, 0.01, 0.9, 1.2, kSteel, kSquare, kSeen},
                                   {0.31, -0.06, 0.015, 0.01, 0.9, 1.2, kSteel, kSquare, kSeen}};
constexpr Part kCounterParts[] = {{-0.02, 0, 0.28, 1, 0, 0.87, kWhite},
                                  {0, 0, 0.32, 1, 0.87, 0.91, kWalnut},
                                  {-0.13, 0, 0.17, 1, 1.45, 2.1, kWhite}};
constexpr Part kFridgeParts[] = {{0, 0, 0.32, 0.3, 0, 1.8, kSteel},
                                 {0.33, 0.24, 0.015, 0.012, 0.9, 1.5, kDark, kSquare, kSeen}};
constexpr Part kTelevisionParts[] = {{0, 0, 0.2, 0.8, 0.05, 0.45, kWalnut},
                                     {-0.05, 0, 0.02, 0.6, 0.52, 1.2, kDark},
                                     {-0.05, 0, 0.1, 0.15, 0.45, 0.52, kDark, kSquare, kSeen}};
constexpr Part kPlantParts[] = {{0, 0, 0.17, 0, 0, 0.32, kClay, kRound},
                                {0, 0, 0.03, 0, 0.32, 0.7, kWalnut, kRound},
                                {0, 0, 0.28, 0, 0.7, 1, kLeaf, kRound},
                                {0, 0, 0.2, 0, 1, 1.3, kLeaf, kRound}};
constexpr Part kLampParts[] = {{0, 0, 0.15, 0, 0, 0.03, kDark, kRound},
                               {0, 0, 0.015, 0, 0.03, 1.4, kDark, kRound},
                               {0, 0, 0.2, 0, 1.4, 1.7, kLinen, kRound}};
constexpr Part kBathParts[] = {{0, 0, 0.85, 0.35, 0, 0.45, kWhite},
                               {0, 0.36, 0.87, 0.03, 0, 0.57, kWhite},
                               {0, -0.36, 0.87, 0.03, 0, 0.57, kWhite},
                               {0.85, 0, 0.03, 0.36, 0, 0.57, kWhite},
                               {-0.85, 0, 0.03, 0.36, 0, 0.57, kWhite}};
constexpr Part kToiletParts[] = {{0.08, 0, 0.2, 0, 0, 0.42, kWhite, kRound},
                                 {-0.2, 0, 0.1, 0.2, 0, 0.8, kWhite}};
constexpr Part kBasinParts[] = {{0, 0, 0.22, 0.3, 0.7, 0.85, kWhite},
                                {-0.1, 0, 0.08, 0, 0, 0.7, kWhite, kRound}};
constexpr Part kDoorLeafParts[] = {{0.46, 0, 0.46, 0.02, 0.01, 2.05, kOak},
                                   {0.84, 0, 0.05, 0.06, 1, 1.03, kSteel, kSquare, kSeen}};
constexpr Part kRackParts[] = {{0.5, 1.35, 0.04, 0.04, 0, 3.6, kBlue},
                               {0.5, -1.35, 0.04, 0.04, 0, 3.6, kBlue},
                               {-0.5, 1.35, 0.04, 0.04, 0, 3.6, kBlue},
                               {-0.5, -1.35, 0.04, 0.04, 0, 3.6, kBlue},
                               {0, 0, 0.52, 1.31, 1.5, 1.54, kPine},
                               {0.53, 0, 0.02, 1.31, 1.42, 1.54, kOrange, kSquare, kSeen},
                               {-0.53, 0, 0.02, 1.31, 1.42, 1.54, kOrange, kSquare, kSeen},
                               {0, 0, 0.52, 1.31, 3, 3.04, kPine},
                               {0.53, 0, 0.02, 1.31, 2.92, 3.04, kOrange, kSquare, kSeen},
                               {-0.53, 0, 0.02, 1.31, 2.92, 3.04, kOrange, kSquare, kSeen}};
// The deck and the blocks of a pallet of 1.2 by 0.8 m.
constexpr Part kPalletParts[] = {{0, 0, 0.4, 0.6, 0.1, 0.144, kPine},
                                 {0, 0.53, 0.4, 0.07, 0, 0.1, kPine},
                                 {0, 0, 0.4, 0.07, 0, 0.1, kPine},
                                 {0, -0.53, 0.4, 0.07, 0, 0.1, kPine}};
constexpr Part kBollardParts[] = {{0, 0, 0.08, 0, 0, 0.6, kYellow, kRound},
                                  {0, 0, 0.082, 0, 0.6, 0.8, kDark, kRound},
                                  {0, 0, 0.08, 0, 0.8, 0.95, kYellow, kRound}};
constexpr Part kStreetLampParts[] = {{0, 0, 0.07, 0, 0, 5, kDark, kRound},
                                     {0.4, 0, 0.5, 0.06, 5, 5.1, kDark},
                                     {0.7, 0, 0.25, 0.12, 4.92, 5, kLinen, kSquare, kSeen}};
constexpr Part kTreeParts[] = {{0, 0, 0.14, 0, 0, 2.2, kWalnut, kRound},
                               {0, 0, 1.1, 0, 2.1, 3, kLeaf, kRound},
                               {0, 0, 0.8, 0, 3, 3.7, kLeaf, kRound},
                               {0, 0, 0.45, 0, 3.7, 4.2, kLeaf, kRound}};
constexpr Part kCarParts[] = {{0, 0, 2.1, 0.88, 0.22, 0.8, kRed},
                              {-0.25, 0, 1.15, 0.78, 0.8, 1.4, kGlass},
                              {-0.25, 0, 1.1, 0.8, 1.4, 1.45, kRed, kSquare, kSeen},
                              {1.3, 0, 0.31, 0.9, 0, 0.5, kDark},
                              {-1.3, 0, 0.31, 0.9, 0, 0.5, kDark}};
constexpr Part kBenchParts[] = {
    {0, 0, 0.22, 0.8, 0.4, 0.45, kOak},          {-0.22, 0, 0.02, 0.8, 0.55, 0.85, kOak},
    {0, 0.65, 0.22, 0.04, 0, 0.4, kDark},        {0, -0.65, 0.22, 0.04, 0, 0.4, kDark},
    {-0.22, 0.65, 0.02, 0.04, 0.4, 0.55, kDark}, {-0.22, -0.65, 0.02, 0.04, 0.4, 0.55, kDark}};
constexpr Part kBinParts[] = {{0, 0, 0.2, 0, 0, 0.7, kLeaf, kRound},
                              {0, 0, 0.22, 0, 0.7, 0.76, kDark, kRound}};
// 6 m wide; its front is at x = 0, with windows, a door and two steps before it.
constexpr Part kHouseParts[] = {{-2, 0, 2, 3, 0, 6, kBrick},
                                {0.3, -1.5, 0.3, 0.7, 0, 0.16, kSteel},
                                {0.15, -1.5, 0.15, 0.7, 0.16, 0.32, kSteel},
                                {0, -1.5, 0.03, 0.5, 0.32, 2.4, kWalnut, kSquare, kSeen},
                                {0, 1.2, 0.03, 0.8, 1, 2.4, kGlass, kSquare, kSeen},
                                {0, 1.2, 0.03, 0.8, 3.8, 5.2, kGlass, kSquare, kSeen},
                                {0, -1.5, 0.03, 0.8, 3.8, 5.2, kGlass, kSquare, kSeen},
                                {-2, 0, 2.1, 3.05, 6, 6.2, kDark, kSquare, kSeen}};

}  // namespace

constexpr std::span<const Part> kTable = kTableParts, kLowTable = kLowTableParts,
                                kChair = kChairParts, kOfficeChair = kOfficeChairParts,
                                kSofa = kSofaParts, kBed = kBedParts, kDesk = kDeskParts,
                                kBookshelf = kBookshelfParts, kWardrobe = kWardrobeParts,
                                kCounter = kCounterParts, kFridge = kFridgeParts,
                                kTelevision = kTelevisionParts, kPlant = kPlantParts,
                                kLamp = kLampParts, kBath = kBathParts, kToilet = kToiletParts,
                                kBasin = kBasinParts, kDoorLeaf = kDoorLeafParts,
                                kRack = kRackParts, kPallet = kPalletParts,
                                kBollard = kBollardParts, kStreetLamp = kStreetLampParts,
                                kTree = kTreeParts, kCar = kCarParts, kBench = kBenchParts,
                                kBin = kBinParts, kHouse = kHouseParts;

void Furnisher::Add(TerrainPiece piece) {
  piece.friction = friction_;
  pieces_->Add(piece);
  if (piece.solid) standing_.push_back(piece);
}

void Furnisher::Put(std::span<const Part> parts, const Spot& spot) {
  const double c = std::cos(spot.yaw), s = std::sin(spot.yaw);
  for (const Part& part : parts) {
    Add({.shape = part.shape,
         .x = spot.x + c * part.x - s * part.y,
         .y = spot.y + s * part.x + c * part.y,
         .top = part.top,
         .half_x = part.half_x,
         .half_y = part.half_y,
         .thickness = part.top - part.bottom,
         .yaw = spot.yaw,
         .colour = part.colour,
         .solid = part.solid});
  }
}

void Furnisher::Pave(const Part& part) {
  Put({&part, 1}, {});
  standing_.pop_back();
}

void Furnisher::Lay(const LooseThing& thing, double radius, double height) {
  pieces_->AddLoose(thing);
  standing_.push_back({.shape = PieceShape::kCylinder,
                       .x = thing.x,
                       .y = thing.y,
                       .top = thing.z + height,
                       .half_x = radius,
                       .half_y = radius,
                       .thickness = height});
}

void Furnisher::PutWall(const WallLine& line, double height, const char* colour,
                        std::span<const Opening> openings) {
  const auto put_panel = [&](double from, double to, double bottom) {
    const double middle = (from + to) / 2, half = (to - from) / 2;
    Add({.x = line.along_x ? middle : line.across,
         .y = line.along_x ? line.across : middle,
         .top = height,
         .half_x = line.along_x ? half : kWallHalf,
         .half_y = line.along_x ? kWallHalf : half,
         .thickness = height - bottom,
         .colour = colour});
  };
  const auto put = [&](double from, double to, double bottom) {
    const double panels = std::ceil((to - from) / kPanel);
    for (double i = 0; i < panels; ++i) {
      put_panel(from + (to - from) * i / panels, from + (to - from) * (i + 1) / panels, bottom);
    }
  };
  const double more = line.along_x ? kWallHalf : -kWallHalf;
  double from = line.from - more;
  for (const Opening& opening : openings) {
    put(from, opening.at - opening.width / 2, 0);
    from = opening.at + opening.width / 2;
    put(opening.at - opening.width / 2, from, kLintel);
    openings_.push_back(line.along_x ? Spot{.x = opening.at, .y = line.across}
                                     : Spot{.x = line.across, .y = opening.at});
  }
  put(from, line.to + more, 0);
}

void Furnisher::Paint(double x, double y, double half_x, double half_y, const char* colour,
                      int layer) {
  Add({.shape = PieceShape::kSheet,
       .x = x,
       .y = y,
       .top = kLayer * layer,
       .half_x = half_x,
       .half_y = half_y,
       .thickness = 0,
       .colour = colour,
       .solid = false});
}

void Furnisher::Hang(const Part& part) {
  Add({.x = part.x,
       .y = part.y,
       .top = part.top,
       .half_x = part.half_x,
       .half_y = part.half_y,
       .thickness = part.top - part.bottom,
       .colour = part.colour,
       .solid = false});
}

void Furnisher::PutRamp(const Spot& spot, double run, double rise, double half_width,
                        const char* colour) {
  const double length = std::hypot(run, rise);
  Add({.x = spot.x + std::cos(spot.yaw) * run / 2,
       .y = spot.y + std::sin(spot.yaw) * run / 2,
       .top = rise / 2,
       .half_x = length / 2,
       .half_y = half_width,
       .thickness = length,  // as thick as long: see AddRamp of blocks.cc
       .pitch = -std::atan2(rise, run),
       .yaw = spot.yaw,
       .colour = colour});
}

bool Furnisher::IsFree(double x, double y, double radius, double height) const {
  if (std::abs(x) < kStartHalfX + radius && std::abs(y) < kStartHalfY + radius) return false;
  const auto near_opening = [&](const Spot& o) {
    return std::hypot(x - o.x, y - o.y) < kBeforeOpening + radius;
  };
  if (std::ranges::any_of(openings_, near_opening)) return false;
  return std::ranges::none_of(standing_, [&](const TerrainPiece& piece) {
    if (piece.top - piece.thickness.value_or(piece.top) >= height) return false;
    const double c = std::cos(piece.yaw), s = std::sin(piece.yaw);
    const double along = c * (x - piece.x) + s * (y - piece.y);
    const double across = c * (y - piece.y) - s * (x - piece.x);
    const bool round = piece.shape == PieceShape::kCylinder;
    return std::abs(along) < piece.half_x + radius &&
           std::abs(across) < (round ? piece.half_x : piece.half_y) + radius;
  });
}

}  // namespace understudy::terrain
