#include <algorithm>
#include <cmath>

#include "terrain/kinds.h"

namespace understudy::terrain {
namespace {

// The curricula of Isaac Lab and legged_gym both end at a grade of 0.4 and at stairs of 0.23 m
// rise; Isaac Lab's treads are 0.3 m deep, legged_gym's gaps are up to 1 m wide
// (docs/reference/terrain.md). The other figures are assumed.
constexpr double kMostGrade = 0.4;
constexpr double kRise = 0.01, kRiseByDifficulty = 0.22;  // m
constexpr double kTread = 0.3;                            // m
constexpr double kLanding = 1;                            // m, at least, after the last step
constexpr int kMostSteps = 10;
constexpr double kTreadThickness = 0.04;  // m, of floating stairs
constexpr double kPlateau = 1;            // m on top of the slopes
constexpr double kMostGap = 1;            // m
constexpr double kPlank = 0.8;            // m between two gaps
constexpr double kPitDepth = 0.5;         // m

void AddStrip(const Stretch& s, double x0, double x1, double top, TerrainPieces* pieces) {
  pieces->AddGround(x0, x1, -s.width / 2, s.width / 2, top, s.friction);
}

// Adds a block whose top goes from (x0, z0) to (x1, z1). It is as thick as it is long: MuJoCo looks
// for the contact of a box and a cylinder along the line between their middles, which would leave a
// thin plank by its end, so that wheels met a wall where it begins.
void AddRamp(const Stretch& s, double x0, double z0, double x1, double z1, TerrainPieces* pieces) {
  const double length = std::hypot(x1 - x0, z1 - z0);
  pieces->Add({.x = (x0 + x1) / 2,
               .top = (z0 + z1) / 2,
               .half_x = length / 2,
               .half_y = s.width / 2,
               .thickness = length,
               .pitch = std::atan2(z0 - z1, x1 - x0),
               .friction = s.friction});
}

double Rise(const Stretch& s) { return OnHeightLattice(kRise + kRiseByDifficulty * s.difficulty); }

int Steps(const Stretch& s) {
  return std::min(kMostSteps, static_cast<int>((s.length - kLanding) / kTread));
}

// Adds solid steps, each `rise` higher than the one before, and a landing at the height of the
// last.
double AddFlight(const Stretch& s, double rise, TerrainPieces* pieces) {
  const int steps = Steps(s);
  double top = s.level;
  for (int i = 0; i < steps; ++i) {
    top = s.level + rise * (i + 1);
    const double x = s.x + kTread * i;
    AddStrip(s, x, i + 1 == steps ? s.x + s.length : x + kTread, top, pieces);
  }
  return top;
}

}  // namespace

double AddFlat(const Stretch& s, TerrainPieces* pieces) {
  AddStrip(s, s.x, s.x + s.length, s.level, pieces);
  return s.level;
}

double AddSlopes(const Stretch& s, TerrainPieces* pieces) {
  const double run = (s.length - kPlateau) / 2;
  const double top = s.level + OnHeightLattice(kMostGrade * s.difficulty * run);
  if (top == s.level) return AddFlat(s, pieces);
  AddRamp(s, s.x, s.level, s.x + run, top, pieces);
  AddStrip(s, s.x + run, s.x + run + kPlateau, top, pieces);
  AddRamp(s, s.x + run + kPlateau, top, s.x + s.length, s.level, pieces);
  pieces->Lower(s.level);
  return s.level;
}

double AddStairsUp(const Stretch& s, TerrainPieces* pieces) {
  return AddFlight(s, Rise(s), pieces);
}

double AddStairsDown(const Stretch& s, TerrainPieces* pieces) {
  return AddFlight(s, -Rise(s), pieces);
}

double AddFloatingStairs(const Stretch& s, TerrainPieces* pieces) {
  const int steps = Steps(s);
  const double rise = Rise(s);
  for (int i = 0; i < steps; ++i) {
    pieces->Add({.x = s.x + kTread * (i + 0.5),
                 .top = s.level + rise * (i + 1),
                 .half_x = kTread / 2,
                 .half_y = s.width / 2,
                 .thickness = kTreadThickness,
                 .friction = s.friction});
  }
  const double top = s.level + rise * steps;
  AddStrip(s, s.x + kTread * steps, s.x + s.length, top, pieces);
  pieces->Lower(s.level);
  return top;
}

double AddGaps(const Stretch& s, TerrainPieces* pieces) {
  const double gap = OnHeightLattice(kMostGap * s.difficulty);
  if (gap == 0) return AddFlat(s, pieces);
  const int gaps = static_cast<int>(s.length / (gap + kPlank));
  for (int i = 0; i < gaps; ++i) {
    const double x = s.x + (gap + kPlank) * i;
    AddStrip(s, x + gap, i + 1 == gaps ? s.x + s.length : x + gap + kPlank, s.level, pieces);
  }
  AddStrip(s, s.x, s.x + s.length, s.level - kPitDepth, pieces);
  return s.level;
}

}  // namespace understudy::terrain
