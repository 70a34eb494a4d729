#include "terrain/scan.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <span>
#include <utility>

#include <Eigen/Geometry>

#include "base/errors.h"
#include "base/printed.h"
#include "mjcf/stl.h"
#include "terrain/file.h"
#include "terrain/pieces.h"

namespace understudy::terrain {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

constexpr double kLargest = 200;         // m
constexpr double kMostSurface = 50'000;  // m²
constexpr int kMostPoints = 2000;        // of the height field, along a side
constexpr std::size_t kOfTriangle = 9;
constexpr std::size_t kMostFaces = 200'000;  // of an STL file that MuJoCo reads

Vector3d Corner(std::span<const float> corners, std::size_t i) {
  return {corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]};
}

template <class F>
void ForEachTriangle(const Scan& scan, F f) {
  for (const mjcf::MeshPart& part : scan) {
    const std::span<const float> corners = part.corners;
    for (std::size_t i = 0; i + kOfTriangle <= corners.size(); i += kOfTriangle) {
      const std::span<const float> triangle = corners.subspan(i, kOfTriangle);
      f(Corner(triangle, 0), Corner(triangle, 1), Corner(triangle, 2));
    }
  }
}

void CheckSize(const std::string& file, const Scan& scan) {
  AlignedBox3d box;
  double surface = 0;
  ForEachTriangle(scan, [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    for (const Vector3d* const corner : {&a, &b, &c}) box.extend(*corner);
    surface += (b - a).cross(c - a).norm() / 2;
  });
  const double side = box.sizes().maxCoeff();
  if (!(side <= kLargest)) {
    throw ModelError(file + ": " + Printed("%.0f m", side) +
                     " large; expected at most 200 m. terrain.scan.scale is the m of its unit");
  }
  if (!(surface <= kMostSurface)) {
    throw ModelError(file + Printed(": %.0f m² of surface; expected at most 50000", surface));
  }
}

// The points of a height field over a scan.
class Heights {
 public:
  Heights(const AlignedBox3d& box, double cell) : low_(box.min().head<2>()) {
    const Eigen::Vector2d size = box.sizes().head<2>().cwiseMax(2 * cell);
    const auto count = [&](double side) {
      return std::min(static_cast<int>(std::ceil(side / cell)) + 1, kMostPoints);
    };
    grid_.columns = count(size.x());
    grid_.rows = count(size.y());
    step_ = {size.x() / (grid_.columns - 1), size.y() / (grid_.rows - 1)};
    grid_.z.assign(static_cast<std::size_t>(grid_.rows) * static_cast<std::size_t>(grid_.columns),
                   kNothing);
  }

  // Raises the points nearest to those of a triangle that are not above `most`.
  void Cover(const Vector3d& a, const Vector3d& b, const Vector3d& c, double most) {
    if (std::min({a.z(), b.z(), c.z()}) > most) return;
    const double spacing = step_.minCoeff() / 2;
    const auto parts = [spacing](double length) {
      return std::max(1, static_cast<int>(std::ceil(length / spacing)));
    };
    const int rows = parts(std::max((b - a).norm(), (c - a).norm()));
    for (int i = 0; i <= rows; ++i) {
      const double u = static_cast<double>(i) / rows;
      const Vector3d from = a + u * (b - a), to = a + u * (c - a);
      const int columns = parts((to - from).norm());
      for (int j = 0; j <= columns; ++j) {
        const Vector3d point = from + static_cast<double>(j) / columns * (to - from);
        if (point.z() > most) continue;
        float& z = At(point);
        z = std::max(z, static_cast<float>(OnHeightLattice(point.z())));
      }
    }
  }

  // Gives points without a height that of the nearest with one, ring by ring.
  void Fill() {
    std::vector<std::size_t> edge;
    for (std::size_t i = 0; i < grid_.z.size(); ++i) {
      if (grid_.z[i] != kNothing) edge.push_back(i);
    }
    while (!edge.empty()) {
      std::vector<std::size_t> next;
      for (const std::size_t i : edge) {
        for (const std::size_t beside : Beside(i)) {
          if (grid_.z[beside] != kNothing) continue;
          grid_.z[beside] = grid_.z[i];
          next.push_back(beside);
        }
      }
      edge = std::move(next);
    }
  }

  bool empty() const { return std::ranges::count(grid_.z, kNothing) == std::ssize(grid_.z); }
  double lowest() const { return *std::ranges::min_element(grid_.z); }

  void AddTo(TerrainPieces* pieces, double friction) {
    const Eigen::Vector2d half =
        step_.cwiseProduct(Eigen::Vector2d(grid_.columns - 1, grid_.rows - 1) / 2);
    const Eigen::Vector2d middle = low_ + half;
    pieces->AddHeights(middle.x(), middle.y(), half.x(), half.y(), friction, std::move(grid_));
  }

 private:
  static constexpr float kNothing = -std::numeric_limits<float>::infinity();

  float& At(const Vector3d& point) {
    const auto place = [](double at, double step, int count) {
      return std::clamp(static_cast<int>(std::lround(at / step)), 0, count - 1);
    };
    const int column = place(point.x() - low_.x(), step_.x(), grid_.columns);
    const int row = place(point.y() - low_.y(), step_.y(), grid_.rows);
    return grid_.z[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.columns) +
                   static_cast<std::size_t>(column)];
  }

  std::vector<std::size_t> Beside(std::size_t i) const {
    const auto columns = static_cast<std::size_t>(grid_.columns);
    std::vector<std::size_t> beside;
    if (i % columns > 0) beside.push_back(i - 1);
    if (i % columns + 1 < columns) beside.push_back(i + 1);
    if (i >= columns) beside.push_back(i - columns);
    if (i + columns < grid_.z.size()) beside.push_back(i + columns);
    return beside;
  }

  Eigen::Vector2d low_, step_;
  HeightGrid grid_;
};

TerrainPieces Touched(const Scan& scan, const TerrainSpec& spec) {
  AlignedBox3d box;
  ForEachTriangle(scan, [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    for (const Vector3d* const corner : {&a, &b, &c}) box.extend(*corner);
  });
  Heights heights(box, spec.scan.cell);
  ForEachTriangle(scan, [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    heights.Cover(a, b, c, spec.scan.height);
  });
  if (heights.empty()) {
    throw ModelError("the scan begins at z = " + Printed("%g", box.min().z()) +
                     " m, above terrain.scan.height, " + Printed("%g", spec.scan.height) +
                     " m: nothing of it can be touched");
  }
  heights.Fill();
  TerrainPieces pieces;
  pieces.PaintFloor("0.6 0.6 0.58 1");  // and so the light of places
  pieces.Lower(heights.lowest() - kOverFloor);
  heights.AddTo(&pieces, spec.friction);
  return pieces;
}

// MuJoCo asks every mesh for a volume, which a wall alone has not: a pyramid of 1 cm makes one.
void AddVolume(std::vector<float>* corners) {
  const auto corner = [&](float x, float y, float z) {
    const float at[] = {(*corners)[0] + x, (*corners)[1] + y, (*corners)[2] + z};
    return std::array<float, 3>{at[0], at[1], at[2]};
  };
  constexpr float kSide = 0.01F;
  const std::array<std::array<float, 3>, 4> p{corner(0, 0, 0), corner(kSide, 0, 0),
                                              corner(0, kSide, 0), corner(0, 0, kSide)};
  constexpr std::array<std::array<std::size_t, 3>, 4> kFaces{
      {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  for (const auto& face : kFaces) {
    for (const std::size_t i : face) corners->insert(corners->end(), p[i].begin(), p[i].end());
  }
}

// What of scene.xml cameras see in place of the height field.
struct Seen {
  std::string assets, geoms;
};

Seen WriteMeshes(const Scan& scan, const std::filesystem::path& folder) {
  constexpr std::array<double, 4> kGrey{0.7, 0.68, 0.65, 1};
  Seen seen;
  int number = 0;
  for (const mjcf::MeshPart& part : scan) {
    const auto [r, g, b, a] = part.rgba.value_or(kGrey);
    const std::span<const float> all = part.corners;
    constexpr std::size_t kMost = (kMostFaces - 4) * kOfTriangle;
    for (std::size_t from = 0; from < all.size(); from += kMost) {
      const std::span<const float> some = all.subspan(from, std::min(kMost, all.size() - from));
      std::vector<float> corners(some.begin(), some.end());
      AddVolume(&corners);
      const std::string name = "scan_" + std::to_string(number++);
      WriteBytes(folder / (name + ".stl"), mjcf::Stl(corners));
      seen.assets += "    <mesh name=\"" + name + "\" file=\"" + name + ".stl\"/>\n";
      seen.geoms += "    <geom name=\"" + name + "\" type=\"mesh\" mesh=\"" + name +
                    "\" contype=\"0\" conaffinity=\"0\" rgba=\"" + Printed("%g", r) + " " +
                    Printed("%g", g) + " " + Printed("%g", b) + " " + Printed("%g", a) + "\"/>\n";
    }
  }
  return seen;
}

}  // namespace

Scan ReadScan(const std::filesystem::path& file, const ScanSpec& spec) {
  const Eigen::Quaterniond turn(spec.quat[0], spec.quat[1], spec.quat[2], spec.quat[3]);
  if (turn.norm() < 1e-3) throw ModelError("terrain.scan.quat: expected w, x, y, z, not all 0");
  const Eigen::Affine3d place = Eigen::Translation3d(spec.pos[0], spec.pos[1], spec.pos[2]) *
                                turn.normalized() * Eigen::Scaling(spec.scale);
  Scan scan = mjcf::ReadMeshFile(file);
  for (mjcf::MeshPart& part : scan) {
    for (std::size_t i = 0; 3 * i < part.corners.size(); ++i) {
      const Vector3d at = place * Corner(part.corners, i);
      for (int axis = 0; axis < 3; ++axis) {
        part.corners[3 * i + static_cast<std::size_t>(axis)] = static_cast<float>(at[axis]);
      }
    }
  }
  CheckSize(file.string(), scan);
  return scan;
}

void WriteScan(const Scan& scan, const TerrainSpec& spec, const std::filesystem::path& folder) {
  const TerrainPieces pieces = Touched(scan, spec);
  WriteTerrainFiles(pieces, "scan", spec.friction, folder);
  const Seen seen = WriteMeshes(scan, folder);
  WriteSightFile(pieces, "scan", seen.assets, seen.geoms, folder);
}

}  // namespace understudy::terrain
