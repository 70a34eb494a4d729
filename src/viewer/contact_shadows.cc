#include "viewer/contact_shadows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "physics/geom_extent.h"

namespace understudy::viewer {
namespace {

// All *assumed*: what looked right.
constexpr double kShadowReach = 0.08;  // m above the ground from which there is no shadow
constexpr double kSole = 0.03;         // m above a body's lowest point: what of it treads
constexpr double kSheetStep = 0.0004;  // m from one sheet up to the next, or they flicker
// Ovals that make one shadow, from the outside inwards.
struct Layer {
  double wider;  // m, than what treads
  float alpha;   // of a sheet
};
constexpr Layer kLayers[] = {{0.040, 0.03F}, {0.027, 0.04F}, {0.016, 0.05F}, {0.007, 0.06F}};
// Each oval is made of rectangles within it, of these parts of its length; of its breadth they have
// what the oval leaves. Anything but a plane would cast a shadow of its own.
constexpr double kSheetParts[] = {0.97, 0.87, 0.71, 0.50, 0.26};

// The rectangle on the ground in which a body treads.
struct Tread {
  double x = 0, y = 0, z = 0;     // m, its middle; z of the lowest point
  double half_x = 0, half_y = 0;  // m
  double cosine = 1, sine = 0;    // of its heading
  int geom = 0;                   // the lowest
};

// How far the geom extends along the horizontal unit vector (x, y) from its origin [m].
double HorizontalReach(const mjModel& model, const mjData& data, int geom, double x, double y) {
  const mjtNum* at = data.geom_xmat + 9 * static_cast<std::ptrdiff_t>(geom);
  const mjtNum direction[3] = {at[0] * x + at[3] * y, at[1] * x + at[4] * y, at[2] * x + at[5] * y};
  return physics::Reach(model, geom, direction);
}

std::optional<Tread> TreadOf(const mjModel& model, const mjData& data, int body) {
  const int first = model.body_geomadr[body];
  const int end = first + model.body_geomnum[body];
  Tread tread;
  tread.z = std::numeric_limits<double>::infinity();
  for (int geom = first; geom < end; ++geom) {
    if (!physics::Collides(model, geom)) continue;
    const double low = physics::LowestPoint(model, data, geom);
    if (low < tread.z) {
      tread.z = low;
      tread.geom = geom;
    }
  }
  if (!std::isfinite(tread.z)) return std::nullopt;
  const mjtNum* turn = data.xmat + 9 * static_cast<std::ptrdiff_t>(body);
  const double length = std::hypot(turn[0], turn[3]);
  if (length > 0.1) {  // else its x axis is steep and gives no heading
    tread.cosine = turn[0] / length;
    tread.sine = turn[3] / length;
  }
  double low[2] = {1e9, 1e9};
  double high[2] = {-1e9, -1e9};
  for (int geom = first; geom < end; ++geom) {
    if (!physics::Collides(model, geom)) continue;
    if (physics::LowestPoint(model, data, geom) > tread.z + kSole) continue;
    const mjtNum* at = data.geom_xpos + 3 * static_cast<std::ptrdiff_t>(geom);
    for (int axis = 0; axis < 2; ++axis) {
      const double x = axis == 0 ? tread.cosine : -tread.sine;
      const double y = axis == 0 ? tread.sine : tread.cosine;
      const double middle = at[0] * x + at[1] * y;
      low[axis] = std::min(low[axis], middle - HorizontalReach(model, data, geom, -x, -y));
      high[axis] = std::max(high[axis], middle + HorizontalReach(model, data, geom, x, y));
    }
  }
  const double ahead = (low[0] + high[0]) / 2;
  const double aside = (low[1] + high[1]) / 2;
  tread.x = ahead * tread.cosine - aside * tread.sine;
  tread.y = ahead * tread.sine + aside * tread.cosine;
  tread.half_x = (high[0] - low[0]) / 2;
  tread.half_y = (high[1] - low[1]) / 2;
  return tread;
}

// Height of the ground below that point [m]; nullopt if there is none near, or something between.
std::optional<double> GroundBelow(const mjModel& model, const mjData& data,
                                  const std::function<bool(int)>& of_robots, const Tread& tread,
                                  int body) {
  constexpr double kAbove = 0.02;  // m: a foot sinks into the ground a little
  const mjtNum from[3] = {tread.x, tread.y, tread.z + kAbove};
  const mjtNum down[3] = {0, 0, -1};
  int geom = -1;
  const double far = mj_ray(&model, &data, from, down, nullptr, 1, body, &geom);
  if (geom < 0 || far > kAbove + kShadowReach || of_robots(geom)) return std::nullopt;
  if (model.body_weldid[model.geom_bodyid[geom]] != 0) return std::nullopt;
  return from[2] - far;
}

void AddSheets(const Tread& tread, double ground, double strength, mjvScene* scene) {
  const mjtNum turn[9] = {tread.cosine, -tread.sine, 0, tread.sine, tread.cosine, 0, 0, 0, 1};
  double height = ground;
  for (const Layer& layer : kLayers) {
    const float black[4] = {0, 0, 0, layer.alpha * static_cast<float>(strength)};
    for (const double part : kSheetParts) {
      if (scene->ngeom >= scene->maxgeom) return;
      height += kSheetStep;
      const mjtNum size[3] = {part * (tread.half_x + layer.wider),
                              std::sqrt(1 - part * part) * (tread.half_y + layer.wider), 1};
      const mjtNum at[3] = {tread.x, tread.y, height};
      mjvGeom* sheet = scene->geoms + scene->ngeom++;
      mjv_initGeom(sheet, mjGEOM_PLANE, size, at, turn, black);
      sheet->category = mjCAT_DECOR;
    }
  }
}

}  // namespace

void AddContactShadows(const mjModel& model, const mjData& data,
                       const std::function<bool(int geom)>& of_robots, mjvScene* scene) {
  for (int body = 1; body < model.nbody; ++body) {
    if (model.body_weldid[body] == 0 || model.body_geomnum[body] == 0) continue;
    const std::optional<Tread> tread = TreadOf(model, data, body);
    if (!tread) continue;
    const auto ground = GroundBelow(model, data, of_robots, *tread, body);
    if (!ground) continue;
    const double strength = 1 - std::clamp((tread->z - *ground) / kShadowReach, 0.0, 1.0);
    AddSheets(*tread, *ground, strength, scene);
  }
}

}  // namespace understudy::viewer
