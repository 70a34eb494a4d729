#include "perception/shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <mujoco/mujoco.h>

#include "mjcf/eigen_views.h"

namespace understudy::perception {
namespace {

using Eigen::Vector3d;

constexpr double kParallel = 1e-15;

// The least root t >= 0 of a t² + 2 b t + c for which valid(t).
template <class Valid>
double LeastRoot(double a, double b, double c, Valid valid) {
  const double square = b * b - a * c;
  if (square < 0 || a < kParallel) return kNoHit;
  const double root = std::sqrt(square);
  for (const double t : {(-b - root) / a, (-b + root) / a}) {
    if (t >= 0 && valid(t)) return t;
  }
  return kNoHit;
}

double ToEllipsoid(const Vector3d& half, const Ray& ray) {
  const Vector3d o = ray.origin.cwiseQuotient(half), d = ray.direction.cwiseQuotient(half);
  return LeastRoot(d.squaredNorm(), o.dot(d), o.squaredNorm() - 1, [](double) { return true; });
}

double ToPlane(const Vector3d& size, const Ray& ray) {
  if (ray.direction.z() > -kParallel) return kNoHit;
  const double t = -ray.origin.z() / ray.direction.z();
  if (t < 0) return kNoHit;
  for (int i = 0; i < 2; ++i) {
    if (size[i] > 0 && std::abs(ray.origin[i] + t * ray.direction[i]) > size[i]) return kNoHit;
  }
  return t;
}

double ToSide(double radius, double half, const Ray& ray) {
  const auto o = ray.origin.head<2>(), d = ray.direction.head<2>();
  return LeastRoot(d.squaredNorm(), o.dot(d), o.squaredNorm() - radius * radius, [&](double t) {
    return std::abs(ray.origin.z() + t * ray.direction.z()) <= half;
  });
}

double ToCapsule(double radius, double half, const Ray& ray) {
  double nearest = ToSide(radius, half, ray);
  for (const double end : {-half, half}) {
    const Vector3d o = ray.origin - Vector3d(0, 0, end);
    const double t =
        LeastRoot(1, o.dot(ray.direction), o.squaredNorm() - radius * radius, [&](double at) {
          const double z = o.z() + at * ray.direction.z();
          return end < 0 ? z <= 0 : z >= 0;
        });
    nearest = std::min(nearest, t);
  }
  return nearest;
}

double ToCylinder(double radius, double half, const Ray& ray) {
  double nearest = ToSide(radius, half, ray);
  if (std::abs(ray.direction.z()) < kParallel) return nearest;
  for (const double end : {-half, half}) {
    const double t = (end - ray.origin.z()) / ray.direction.z();
    const Eigen::Vector2d at = ray.origin.head<2>() + t * ray.direction.head<2>();
    if (t >= 0 && at.squaredNorm() <= radius * radius) nearest = std::min(nearest, t);
  }
  return nearest;
}

double ToBox(const Vector3d& half, const Ray& ray) {
  double in = -kNoHit, out = kNoHit;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(ray.direction[i]) < kParallel) {
      if (std::abs(ray.origin[i]) > half[i]) return kNoHit;
      continue;
    }
    const double inverse = 1 / ray.direction[i];
    const double a = (-half[i] - ray.origin[i]) * inverse, b = (half[i] - ray.origin[i]) * inverse;
    in = std::max(in, std::min(a, b));
    out = std::min(out, std::max(a, b));
  }
  if (in > out || out < 0) return kNoHit;
  return in >= 0 ? in : out;
}

double ToTriangle(const Triangles::Corners& corners, const Ray& ray) {
  constexpr double kEdge = 1e-12;  // so that no ray passes between two triangles
  const Vector3d ab = corners[1] - corners[0], ac = corners[2] - corners[0];
  const Vector3d p = ray.direction.cross(ac);
  const double determinant = ab.dot(p);
  if (std::abs(determinant) < 1e-18) return kNoHit;
  const double inverse = 1 / determinant;
  const Vector3d s = ray.origin - corners[0];
  const double u = s.dot(p) * inverse;
  if (u < -kEdge || u > 1 + kEdge) return kNoHit;
  const Vector3d q = s.cross(ab);
  const double v = ray.direction.dot(q) * inverse;
  if (v < -kEdge || u + v > 1 + kEdge) return kNoHit;
  const double t = ac.dot(q) * inverse;
  return t >= 0 ? t : kNoHit;
}

std::vector<Triangles::Corners> MeshTriangles(const mjModel& model, int mesh) {
  const float* const points = model.mesh_vert + 3 * model.mesh_vertadr[mesh];
  const int* const faces = model.mesh_face + 3 * model.mesh_faceadr[mesh];
  std::vector<Triangles::Corners> triangles(static_cast<std::size_t>(model.mesh_facenum[mesh]));
  for (std::size_t i = 0; i < 3 * triangles.size(); ++i) {
    const float* const point = points + 3 * faces[i];
    triangles[i / 3][i % 3] = {point[0], point[1], point[2]};
  }
  return triangles;
}

std::vector<Triangles::Corners> FieldTriangles(const mjModel& model, int field) {
  const int rows = model.hfield_nrow[field], columns = model.hfield_ncol[field];
  const mjtNum* const size = model.hfield_size + 4 * field;
  const float* const data = model.hfield_data + model.hfield_adr[field];
  const double dx = 2 * size[0] / (columns - 1), dy = 2 * size[1] / (rows - 1);
  const auto at = [&](int r, int c) {
    return Vector3d(c * dx - size[0], r * dy - size[1], data[r * columns + c] * size[2]);
  };
  std::vector<Triangles::Corners> triangles;
  for (int r = 0; r + 1 < rows; ++r) {
    for (int c = 0; c + 1 < columns; ++c) {
      triangles.push_back({at(r, c), at(r + 1, c + 1), at(r, c + 1)});
      triangles.push_back({at(r, c), at(r + 1, c + 1), at(r + 1, c)});
    }
  }
  const auto add_square = [&](const Vector3d& a, const Vector3d& b, const Vector3d& c,
                              const Vector3d& d) {
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  };
  const auto floor = [&](Vector3d point) {
    point.z() = -size[3];
    return point;
  };
  const auto add_wall = [&](const Vector3d& a, const Vector3d& b) {
    add_square(a, b, floor(b), floor(a));
  };
  for (int c = 0; c + 1 < columns; ++c) {
    for (const int r : {0, rows - 1}) add_wall(at(r, c), at(r, c + 1));
  }
  for (int r = 0; r + 1 < rows; ++r) {
    for (const int c : {0, columns - 1}) add_wall(at(r, c), at(r + 1, c));
  }
  add_square(floor(at(0, 0)), floor(at(0, columns - 1)), floor(at(rows - 1, columns - 1)),
             floor(at(rows - 1, 0)));
  return triangles;
}

// Half the sides of the box around a primitive in its frame.
Vector3d HalfSides(int type, const Vector3d& size) {
  switch (type) {
    case mjGEOM_SPHERE:
      return {size[0], size[0], size[0]};
    case mjGEOM_CAPSULE:
      return {size[0], size[0], size[1] + size[0]};
    case mjGEOM_CYLINDER:
      return {size[0], size[0], size[1]};
    default:
      return size;
  }
}

}  // namespace

Triangles::Triangles(std::vector<Corners> triangles)
    : low_(Vector3d::Constant(kNoHit)), high_(Vector3d::Constant(-kNoHit)) {
  constexpr int kLeaf = 4;
  std::vector<Box> boxes;
  for (const Corners& corners : triangles) {
    const Vector3d low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]);
    const Vector3d high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]);
    boxes.push_back(Box::Around(low, high));
    low_ = low_.cwiseMin(low);
    high_ = high_.cwiseMax(high);
  }
  tree_ = BoxTree(boxes, kLeaf);
  for (const std::uint32_t i : tree_.Renumber()) triangles_.push_back(triangles[i]);
}

double Triangles::Distance(const Ray& ray, double nearest) const {
  double found = nearest;
  tree_.Walk(ray, &found,
             [&](std::uint32_t i) { found = std::min(found, ToTriangle(triangles_[i], ray)); });
  return found < nearest ? found : kNoHit;
}

Triangles TrianglesOf(const mjModel& model, int geom) {
  const int data = model.geom_dataid[geom];
  return Triangles(model.geom_type[geom] == mjGEOM_MESH ? MeshTriangles(model, data)
                                                        : FieldTriangles(model, data));
}

void Shape::Follow(const mjData& data) {
  p_WG = mjcf::Vector(data.geom_xpos + 3 * geom);
  R_WG = mjcf::RotationView(data.geom_xmat + 9 * geom);
}

double Shape::Distance(const Ray& ray, double nearest) const {
  const Ray local{R_WG.transpose() * (ray.origin - p_WG), R_WG.transpose() * ray.direction};
  switch (type) {
    case mjGEOM_PLANE:
      return ToPlane(size, local);
    case mjGEOM_SPHERE:
      return LeastRoot(1, local.origin.dot(local.direction),
                       local.origin.squaredNorm() - size[0] * size[0], [](double) { return true; });
    case mjGEOM_CAPSULE:
      return ToCapsule(size[0], size[1], local);
    case mjGEOM_ELLIPSOID:
      return ToEllipsoid(size, local);
    case mjGEOM_CYLINDER:
      return ToCylinder(size[0], size[1], local);
    case mjGEOM_BOX:
      return ToBox(size, local);
    default:
      return triangles->Distance(local, nearest);
  }
}

Box Shape::Bounds() const {
  const bool solid = triangles == nullptr;
  const Vector3d half = solid ? HalfSides(type, size) : (triangles->high() - triangles->low()) / 2;
  const Vector3d centre = solid ? p_WG : p_WG + R_WG * ((triangles->high() + triangles->low()) / 2);
  const Vector3d reach = R_WG.cwiseAbs() * half;
  return Box::Around(centre - reach, centre + reach);
}

}  // namespace understudy::perception
