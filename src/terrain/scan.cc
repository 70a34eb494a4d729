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
#include "mjcf/compile.h"
#include "mjcf/stl.h"
#include "terrain/file.h"
#include "terrain/pieces.h"

namespace understudy::terrain {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

constexpr double kLargest = 200;      // m
constexpr int kMostPoints = 2000;     // of the height field, along a side
constexpr double kMostSamples = 3e8;  // of surfaces: a second or two
constexpr std::size_t kOfTriangle = 9;

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

AlignedBox3d BoxOf(const Scan& scan) {
  AlignedBox3d box;
  ForEachTriangle(scan, [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    for (const Vector3d* const corner : {&a, &b, &c}) box.extend(*corner);
  });
  return box;
}

void CheckSize(const std::string& file, const Scan& scan) {
  const double side = BoxOf(scan).sizes().maxCoeff();
  if (!(side <= kLargest)) {
    throw ModelError(file + ": " + Printed("%.0f m", side) +
                     " large; expected at most 200 m. terrain.scan.scale is the m of its unit");
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

  // How often Cover samples a triangle, about.
  double SamplesOf(const Vector3d& a, const Vector3d& b, const Vector3d& c) const {
    return (RowsOf(a, b, c) + 1.0) * (PartsOf((c - b).norm()) / 2.0 + 1);
  }

  // Raises the points nearest to those of a triangle that are not above `most`.
  void Cover(const Vector3d& a, const Vector3d& b, const Vector3d& c, double most) {
    if (std::min({a.z(), b.z(), c.z()}) > most) return;
    const int rows = RowsOf(a, b, c);
    for (int i = 0; i <= rows; ++i) {
      const double u = static_cast<double>(i) / rows;
      const Vector3d from = a + u * (b - a), to = a + u * (c - a);
      const int columns = PartsOf((to - from).norm());
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

  // So many parts of a line leave no point between two samples.
  int PartsOf(double length) const {
    return std::max(1, static_cast<int>(std::ceil(2 * length / step_.minCoeff())));
  }
  int RowsOf(const Vector3d& a, const Vector3d& b, const Vector3d& c) const {
    return PartsOf(std::max((b - a).norm(), (c - a).norm()));
  }

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
  const AlignedBox3d box = BoxOf(scan);
  Heights heights(box, spec.scan.cell);
  double samples = 0;
  ForEachTriangle(scan, [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    samples += heights.SamplesOf(a, b, c);
  });
  if (samples > kMostSamples) {
    throw ModelError("terrain.scan.cell: its surfaces would be sampled " +
                     Printed("%.0f", samples * 1e-6) +
                     " million times; expected at most 300: larger cells, or fewer and less "
                     "pointed triangles");
  }
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
    for (const std::string& stl : mjcf::Stls(part.corners)) {
      const std::string name = "scan_" + std::to_string(number++);
      WriteBytes(folder / (name + ".stl"), stl);
      seen.assets += "    <mesh name=\"" + name + "\" file=\"" + name + ".stl\"" +
                     mjcf::SheetAttribute() + "/>\n";
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
