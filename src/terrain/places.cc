#include "terrain/places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "terrain/furniture.h"
#include "terrain/kinds.h"

namespace understudy::terrain {
namespace {

// All sizes of this file are assumed (docs/reference/terrain.md).
constexpr double kRoomHeight = 2.5;  // m
constexpr const char* kPlaster = "0.9 0.89 0.85 1";
constexpr const char* kSage = "0.66 0.72 0.64 1";
constexpr const char* kParquet = "0.66 0.5 0.34 1";
constexpr const char* kTiles = "0.72 0.76 0.78 1";
constexpr const char* kWoolRed = "0.55 0.22 0.2 1";
constexpr const char* kWoolBlue = "0.25 0.34 0.48 1";
constexpr const char* kCarpet = "0.36 0.41 0.46 1";
constexpr const char* kPaintYellow = "0.95 0.78 0.1 1";
constexpr const char* kPaintWhite = "0.93 0.93 0.92 1";
constexpr const char* kPaving = "0.66 0.64 0.6 1";
constexpr const char* kCladding = "0.7 0.74 0.78 1";

// A rectangle [m] in which things stand about: how many at most, and how high its ground is.
struct Area {
  double x0, x1, y0, y1;
  int most;
  double ground = 0;
};

// What lies about and can be pushed over: kinds of objects, with a circle around each [m].
struct LooseKind {
  const char* kind;
  double radius, height;
};
constexpr std::array<LooseKind, 6> kLoose = {{{"ball", 0.12, 0.22},
                                              {"bottle", 0.04, 0.2},
                                              {"box", 0.25, 0.25},
                                              {"crate", 0.29, 0.6},
                                              {"cube", 0.04, 0.05},
                                              {"cup", 0.07, 0.1}}};

constexpr std::array kCardboard = {"0.7 0.54 0.36 1", "0.62 0.47 0.31 1", "0.76 0.6 0.42 1",
                                   "0.85 0.83 0.78 1"};

const char* AnyCardboard(TerrainRandom* random) {
  return kCardboard[static_cast<std::size_t>(random->Between(0, kCardboard.size()))];
}

// Puts small boxes and drums where the area is free.
void Scatter(const Area& area, const PlaceSpec& spec, TerrainRandom* random, Furnisher* furnisher) {
  constexpr double kSmall = 0.08, kBig = 0.25;  // m, half sides
  const int count = static_cast<int>(std::lround(area.most * spec.clutter));
  for (int i = 0; i < count; ++i) {
    const double x = random->Between(area.x0, area.x1), y = random->Between(area.y0, area.y1);
    const double half = random->Between(kSmall, kBig), top = random->Between(0.1, 0.6);
    const double yaw = random->Between(0, kQuarter);
    const auto shape = random->Between(0, 1) < 0.75 ? PieceShape::kBox : PieceShape::kCylinder;
    const double over = area.ground + OnHeightLattice(top);
    const Part part{0, 0, half, half, area.ground, over, AnyCardboard(random), shape};
    if (furnisher->IsFree(x, y, std::hypot(half, half), over))
      furnisher->Put({&part, 1}, {x, y, yaw});
  }
}

// Lays loose things where the area is free.
void Strew(const Area& area, const PlaceSpec& spec, TerrainRandom* random, Furnisher* furnisher) {
  constexpr double kShare = 0.25;  // of the boxes and drums
  constexpr int kAttempts = 20;
  constexpr double kRoom = 0.3;  // m: nothing lies under what is lower, such as a pallet
  const int count = static_cast<int>(std::lround(kShare * area.most * spec.loose));
  for (int i = 0; i < count; ++i) {
    const LooseKind& kind = kLoose[static_cast<std::size_t>(random->Between(0, kLoose.size()))];
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      const double x = random->Between(area.x0, area.x1), y = random->Between(area.y0, area.y1);
      const double yaw = random->Between(0, 4 * kQuarter);
      const double room = area.ground + std::max(kRoom, kind.height);
      if (!furnisher->IsFree(x, y, kind.radius, room)) continue;
      furnisher->Lay({kind.kind, x, y, area.ground, yaw}, kind.radius, kind.height);
      break;
    }
  }
}

// Last, so that what stands about does not change the rest; loose things by numbers of their own.
void FillAreas(std::span<const Area> areas, const PlaceSpec& spec, TerrainRandom* random,
               Furnisher* furnisher) {
  for (const Area& area : areas) Scatter(area, spec, random, furnisher);
  TerrainRandom own(spec.seed + 1);
  for (const Area& area : areas) Strew(area, spec, &own, furnisher);
}

void AddRoomsOfApartment(Furnisher* f) {
  f->Paint(0, 0.7, 3, 2.7, kParquet);
  f->Paint(1.25, -2.8, 1.75, 0.8, kParquet);
  f->Paint(-1.75, -2.8, 1.25, 0.8, kTiles);
  f->Paint(5, 1.7, 2, 1.7, kTiles);
  f->Paint(5, -1.8, 2, 1.8, kParquet);
  f->Paint(0.1, 0.3, 1.5, 1.1, kWoolRed, 2);
  f->Paint(0.1, 0.3, 1.35, 0.95, "0.8 0.7 0.55 1", 3);
  f->Paint(4.6, -1.7, 0.7, 1, kWoolBlue, 2);
  const std::array<Opening, 1> entrance{{{1.2, 1}}}, to_hall{{{1.5, 1}}}, to_bath{{{-2.8, 0.9}}};
  const std::array<Opening, 2> to_rooms{{{-2.8, 0.9}, {1.6, 1.2}}};
  f->PutWall({true, -3, 7, -3.6}, kRoomHeight, kPlaster, entrance);
  f->PutWall({true, -3, 7, 3.4}, kRoomHeight, kPlaster);
  f->PutWall({false, -3.6, 3.4, -3}, kRoomHeight, kSage);
  f->PutWall({false, -3.6, 3.4, 7}, kRoomHeight, kPlaster);
  f->PutWall({false, -3.6, 3.4, 3}, kRoomHeight, kPlaster, to_rooms);
  f->PutWall({true, -2.88, 2.88, -2}, kRoomHeight, kPlaster, to_hall);
  f->PutWall({false, -3.6, -2, -0.5}, kRoomHeight, kPlaster, to_bath);
  f->PutWall({true, 3.12, 6.88, 0}, kRoomHeight, kPlaster);
  f->Hang({-2.93, -0.6, 0.01, 0.5, 1.2, 1.9, "0.85 0.55 0.25 1"});
  f->Hang({-0.2, 3.33, 0.7, 0.01, 1.3, 1.9, "0.25 0.4 0.6 1"});
  f->Hang({-0.2, 3.32, 0.3, 0.01, 1.4, 1.75, "0.9 0.8 0.4 1"});
  f->Hang({6.93, 1.9, 0.01, 0.6, 1, 2, "0.72 0.84 0.93 1"});
}

void AddApartment(const PlaceSpec& spec, TerrainPieces* pieces) {
  Furnisher f(spec.friction, pieces);
  TerrainRandom random(spec.seed);
  AddRoomsOfApartment(&f);
  const auto about = [&](double yaw) { return yaw + random.Between(-0.25, 0.25) * spec.clutter; };
  f.Put(kSofa, {-0.2, 2.85, -kQuarter});
  f.Put(kLowTable, {-0.2, 1.75, kQuarter});
  f.Put(kTelevision, {-1.1, -1.7, kQuarter});
  f.Put(kBookshelf, {-2.77, 1.2, 0});
  f.Put(kBookshelf, {-2.77, 2.25, 0});
  f.Put(kLamp, {-1.7, 3, 0});
  f.Put(kPlant, {2.6, 3, 0});
  f.Put(kPlant, {0.3, -1.65, 0});
  f.Put(kTable, {-2.25, -0.6, 0});
  for (const double y : {-0.9, -0.3}) f.Put(kChair, {-1.75, y, about(2 * kQuarter)});
  f.Put(kCounter, {4.7, 3.04, -kQuarter});
  f.Put(kFridge, {6.1, 3, -kQuarter});
  f.Put(kTable, {5.6, 1.3, 0});
  for (const double y : {0.95, 1.65}) {
    f.Put(kChair, {5, y, about(0)});
    f.Put(kChair, {6.2, y, about(2 * kQuarter)});
  }
  f.Put(kBed, {5.85, -1.7, 2 * kQuarter});
  f.Put(kWardrobe, {5.6, -3.22, kQuarter});
  f.Put(kDesk, {4.1, -0.5, -kQuarter});
  f.Put(kOfficeChair, {4.1, -1.05, about(kQuarter)});
  f.Put(kBath, {-2, -3.15, 0});
  f.Put(kToilet, {-2.6, -2.4, 0});
  f.Put(kBasin, {-1.4, -2.25, -kQuarter});
  FillAreas(std::array<Area, 2>{{{-2.7, 2.7, -1.7, 3.1, 12}, {3.3, 6.7, -3.3, 3.1, 8}}}, spec,
            &random, &f);
}

void AddOfficeRoom(double x, double side, const PlaceSpec& spec, TerrainRandom* random,
                   Furnisher* f) {
  const auto about = [&](double yaw) { return yaw + random->Between(-0.8, 0.8) * spec.clutter; };
  const double towards = side * kQuarter;  // away from the corridor
  f->Put(kDesk, {x - 0.8, side * 4.3, -towards});
  f->Put(kOfficeChair, {x - 0.8, side * 3.6, about(towards)});
  f->Put(kDesk, {x + 1.0, side * 4.3, -towards});
  f->Put(kOfficeChair, {x + 1.0, side * 3.6, about(towards)});
  f->Put(kBookshelf, {x - 1.76, side * 2.7, 0});
  f->Put(kPlant, {x + 1.6, side * 1.6, 0});
  f->Hang({x - 0.9, side * 4.93, 0.6, 0.01, 1.35, 2, "0.86 0.88 0.9 1"});
  f->Put(kDoorLeaf, {x - 0.1, side * 1.26, towards + random->Between(-0.6, 0.2) * side});
}

void AddOffice(const PlaceSpec& spec, TerrainPieces* pieces) {
  constexpr double kBegin = -4, kRoom = 4, kHalf = 1.2, kDeep = 5;
  constexpr int kRooms = 4;
  constexpr double kEnd = kBegin + kRooms * kRoom;
  Furnisher f(spec.friction, pieces);
  TerrainRandom random(spec.seed);
  f.Paint((kBegin + kEnd) / 2, 0, (kEnd - kBegin) / 2, kHalf, kCarpet);
  std::array<Opening, kRooms> doors{};
  for (std::size_t i = 0; i < kRooms; ++i) {
    doors[i] = {kBegin + kRoom * (static_cast<double>(i) + 0.6), 1};
  }
  const std::array<Opening, 1> ends{{{0, 1.6}}};
  for (const double side : {-1.0, 1.0}) {
    f.Paint((kBegin + kEnd) / 2, side * (kHalf + kDeep) / 2, (kEnd - kBegin) / 2,
            (kDeep - kHalf) / 2, "0.6 0.58 0.54 1");
    f.PutWall({true, kBegin, kEnd, side * kHalf}, kRoomHeight, kPlaster, doors);
    f.PutWall({true, kBegin, kEnd, side * kDeep}, kRoomHeight, kSage);
    for (int i = 0; i <= kRooms; ++i) {
      const double x = kBegin + kRoom * i;
      f.PutWall({false, side < 0 ? -kDeep : kHalf, side < 0 ? -kHalf : kDeep, x}, kRoomHeight,
                kPlaster);
      if (i < kRooms) AddOfficeRoom(x + kRoom / 2, side, spec, &random, &f);
    }
  }
  f.PutWall({false, -kHalf, kHalf, kBegin}, kRoomHeight, kPlaster, ends);
  f.PutWall({false, -kHalf, kHalf, kEnd}, kRoomHeight, kPlaster, ends);
  constexpr double kFrom = kBegin + 0.3, kTo = kEnd - 0.3;
  FillAreas(std::array<Area, 4>{{{kFrom, kTo, 0.85, kHalf - 0.1, 8},
                                 {kFrom, kTo, -kHalf + 0.1, -0.85, 8},
                                 {kFrom, kTo, -4.7, -1.5, 16},
                                 {kFrom, kTo, 1.5, 4.7, 16}}},
            spec, &random, &f);
}

// Puts a rack with goods on its two decks and on pallets below.
void AddLoadedRack(const Spot& spot, const PlaceSpec& spec, TerrainRandom* random, Furnisher* f) {
  f->Put(kRack, spot);
  for (const double level : {0.0, 1.54, 3.04}) {
    for (const double y : {-0.66, 0.66}) {
      const double full = random->Between(0, 1);
      const double half = random->Between(0.3, 0.45), high = random->Between(0.5, 1.2);
      const char* const colour = AnyCardboard(random);
      if (full > 0.35 + 0.6 * spec.clutter) continue;
      const double c = std::cos(spot.yaw), s = std::sin(spot.yaw);
      const Spot place{spot.x - s * y, spot.y + c * y, spot.yaw};
      const Part goods{0, 0, half, 0.55, level + 0.144, level + OnHeightLattice(high), colour};
      const Part deck{0, 0, 0.4, 0.6, level + 0.02, level + 0.144, "0.8 0.66 0.46 1"};
      f->Put({&deck, 1}, place);
      f->Put({&goods, 1}, place);
    }
  }
}

void AddWarehouse(const PlaceSpec& spec, TerrainPieces* pieces) {
  constexpr double kX0 = -5, kX1 = 17, kHalf = 7.5, kHigh = 5;
  Furnisher f(spec.friction, pieces);
  TerrainRandom random(spec.seed);
  const std::array<Opening, 1> gate{{{0, 3}}};
  f.PutWall({true, kX0, kX1, -kHalf}, kHigh, kCladding);
  f.PutWall({true, kX0, kX1, kHalf}, kHigh, kCladding);
  f.PutWall({false, -kHalf, kHalf, kX0}, kHigh, kCladding, gate);
  f.PutWall({false, -kHalf, kHalf, kX1}, kHigh, kCladding);
  for (const double y : {-1.5, 1.5})
    f.Paint((kX0 + kX1) / 2, y, (kX1 - kX0) / 2, 0.05, kPaintYellow);
  for (const double x : {-2.4, 14.4}) f.Paint(x, 0, 0.05, kHalf - 0.5, kPaintYellow);
  for (const double y : {-6.6, -2.6, 2.6, 6.6}) {
    for (int bay = 0; bay < 5; ++bay) {
      AddLoadedRack({0.5 + 2.78 * bay, y, y < 0 ? kQuarter : -kQuarter}, spec, &random, &f);
    }
  }
  for (const double y : {-1.75, 1.75}) {
    for (const double x : {-1.2, 13.3}) f.Put(kBollard, {x, y, 0});
  }
  for (const double y : {-5.5, -4.2, 4.2, 5.5}) {
    f.Put(kPallet, {-4, y, 0});
    const Part goods{0, 0, 0.38, 0.55, 0.144, 1, AnyCardboard(&random)};
    f.Put({&goods, 1}, {-4, y, 0});
  }
  FillAreas(std::array<Area, 3>{{{kX0 + 0.5, kX1 - 0.5, -5.6, -3.5, 24},
                                 {kX0 + 0.5, kX1 - 0.5, 3.5, 5.6, 24},
                                 {14.6, kX1 - 0.4, -6, 6, 12}}},
            spec, &random, &f);
}

constexpr double kKerb = 0.12;     // m
constexpr double kRoadHalf = 3.2;  // m
constexpr double kStreetX0 = -12, kStreetX1 = 24;
constexpr double kCrossing = 4, kCrossingHalf = 1.5;  // m: where ramps lead up

// The pavement of a side, with a ramp of a grade of 1 in 8 at the crossing.
void AddPavement(double side, Furnisher* f) {
  constexpr double kWide = 3, kRun = 8 * kKerb;
  const auto slab = [&](double x0, double x1, double from) {
    const Part part{(x0 + x1) / 2, side * (kRoadHalf + (from + kWide) / 2),
                    (x1 - x0) / 2, (kWide - from) / 2,
                    -0.3,          kKerb,
                    kPaving};
    f->Pave(part);
  };
  slab(kStreetX0, kCrossing - kCrossingHalf, 0);
  slab(kCrossing - kCrossingHalf, kCrossing + kCrossingHalf, kRun);
  slab(kCrossing + kCrossingHalf, kStreetX1, 0);
  f->PutRamp({kCrossing, side * kRoadHalf, side * kQuarter}, kRun, kKerb, kCrossingHalf,
             "0.74 0.7 0.62 1");
}

void AddStreet(const PlaceSpec& spec, TerrainPieces* pieces) {
  Furnisher f(spec.friction, pieces);
  TerrainRandom random(spec.seed);
  for (const double side : {-1.0, 1.0}) {
    AddPavement(side, &f);
    const double front = side * (kRoadHalf + 3);
    for (int i = 0; i < 6; ++i) {
      if (random.Between(0, 1) < 0.85) f.Put(kHouse, {-9 + 6.0 * i, front, -side * kQuarter});
    }
    for (int i = 0; i < 4; ++i) {
      const double x = -9.5 + 9 * i;
      f.Put(kStreetLamp, {x, side * (kRoadHalf + 0.4), -side * kQuarter});
      f.Put(kTree, {x + 4.5 > 2 && x + 4.5 < 6 ? 7.5 : x + 4.5, side * (kRoadHalf + 0.7), 0});
    }
    f.Put(kBench, {-2.5, side * (kRoadHalf + 2.4), -side * kQuarter});
    f.Put(kBin, {-1, side * (kRoadHalf + 2.5), 0});
    for (const double x : {2.1, 5.9}) f.Put(kBollard, {x, side * (kRoadHalf + 0.3), 0});
    for (const double x : {-7.5, 10.0, 15.5, 21.0}) {
      const double away = random.Between(-0.4, 0.4);
      if (random.Between(0, 1) < 0.2 + 0.8 * spec.clutter) {
        f.Put(kCar, {x + away, side * (kRoadHalf - 1.05), side < 0 ? 0 : 2 * kQuarter});
      }
    }
  }
  for (double x = kStreetX0 + 1; x < kStreetX1; x += 3) {
    if (std::abs(x - kCrossing) > kCrossingHalf + 1) f.Paint(x, 0, 0.75, 0.06, kPaintWhite);
  }
  for (int i = -4; i <= 4; ++i) {
    f.Paint(kCrossing, 0.7 * i, kCrossingHalf, 0.2, kPaintWhite);
  }
  FillAreas(std::array<Area, 2>{{{kStreetX0, kStreetX1, -5.6, -3.6, 16, kKerb},
                                 {kStreetX0, kStreetX1, 3.6, 5.6, 16, kKerb}}},
            spec, &random, &f);
}

constexpr PlaceKind kPlaces[] = {
    {"apartment", "0.75 0.76 0.76 1", AddApartment},
    {"office", "0.75 0.76 0.76 1", AddOffice},
    {"warehouse", "0.82 0.83 0.84 1", AddWarehouse},
    {"street", "0.42 0.43 0.45 1", AddStreet},
};

}  // namespace

const PlaceKind* FindPlace(const std::string& name) {
  const auto* const found =
      std::ranges::find_if(kPlaces, [&](const PlaceKind& place) { return name == place.name; });
  return found == std::end(kPlaces) ? nullptr : found;
}

std::vector<std::string> PlaceNames() {
  std::vector<std::string> names;
  for (const PlaceKind& place : kPlaces) names.emplace_back(place.name);
  return names;
}

}  // namespace understudy::terrain
