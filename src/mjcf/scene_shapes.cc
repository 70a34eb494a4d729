#include "mjcf/scene_shapes.h"

#include <algorithm>
#include <cstddef>

#include <mujoco/mujoco.h>

#include "mjcf/eigen_views.h"

namespace understudy::mjcf {
namespace {

using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;
using Kind = SceneShape::Kind;

constexpr double kPlaneThickness = 0.01;  // m; *assumed*

// The mean of a texture's picture [0 to 1]; white without one.
std::array<float, 3> MeanColor(const mjModel& model, int material) {
#if mjVERSION_HEADER >= 300
  const int texture = model.mat_texid[material * mjNTEXROLE + mjTEXROLE_RGB];
  const mjtByte* const data = model.tex_data;
  const std::ptrdiff_t channels = texture < 0 ? 0 : model.tex_nchannel[texture];
#else
  const int texture = model.mat_texid[material];
  const mjtByte* const data = model.tex_rgb;
  const std::ptrdiff_t channels = 3;
#endif
  if (texture < 0 || channels < 3) return {1, 1, 1};
  const std::ptrdiff_t pixels =
      std::ptrdiff_t{model.tex_height[texture]} * model.tex_width[texture];
  std::array<double, 3> sum{};
  for (std::ptrdiff_t i = 0; i < pixels; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      sum[k] += data[model.tex_adr[texture] + channels * i + static_cast<std::ptrdiff_t>(k)];
    }
  }
  std::array<float, 3> mean{};
  std::ranges::transform(sum, mean.begin(), [&](double part) {
    return static_cast<float>(part /
                              (255.0 * static_cast<double>(std::max<std::ptrdiff_t>(pixels, 1))));
  });
  return mean;
}

class ShapesMaker {
 public:
  explicit ShapesMaker(const mjModel& model)
      : model_(model), data_(MakeDataWithoutContacts(model)) {
    mj_kinematics(&model_, data_.get());
  }

  std::vector<SceneShape> Make(int base) {
    for (int geom = 0; geom < model_.ngeom; ++geom) {
      const int body = model_.geom_bodyid[geom];
      if (model_.body_weldid[body] != 0 || IsOf(body, base)) continue;
      if (model_.geom_group[geom] > kLastSeenGroup) continue;
      shape_ = {};
      if (const char* const name = mj_id2name(&model_, mjOBJ_GEOM, geom)) shape_.name = name;
      shape_.rgba = ColorOf(geom);
      if (shape_.rgba[3] > 0) Add(geom);
    }
    return std::move(shapes_);
  }

 private:
  // Whether `body` is `base` or below it.
  bool IsOf(int body, int base) const {
    while (body > base && base > 0) body = model_.body_parentid[body];
    return base > 0 && body == base;
  }

  std::array<float, 4> ColorOf(int geom) const {
    const int material = model_.geom_matid[geom];
    const float* const rgba =
        material >= 0 ? model_.mat_rgba + 4 * material : model_.geom_rgba + 4 * geom;
    const std::array<float, 3> mean =
        material >= 0 ? MeanColor(model_, material) : std::array<float, 3>{1, 1, 1};
    return {rgba[0] * mean[0], rgba[1] * mean[1], rgba[2] * mean[2], rgba[3]};
  }

  void Put(Kind kind, const Isometry3d& X_WS, const Vector3d& size) {
    SceneShape shape = shape_;
    shape.kind = kind;
    shape.X_WS = X_WS;
    shape.size = size;
    shapes_.push_back(std::move(shape));
  }

  void Add(int geom) {
    Isometry3d pose(Translation3d(Vector(data_->geom_xpos + 3 * geom)));
    pose.linear() = RotationView(data_->geom_xmat + 9 * geom);
    const Vector3d half = Vector(model_.geom_size + 3 * geom);
    const Vector3d round(2 * half[0], 2 * half[0], 2 * half[1]);
    switch (model_.geom_type[geom]) {
      case mjGEOM_PLANE: {
        const auto whole = [](double one) { return 2 * (one > 0 ? one : kEndlessPlane); };
        return Put(Kind::kBox, pose * Translation3d(0, 0, -kPlaneThickness / 2),
                   {whole(half[0]), whole(half[1]), kPlaneThickness});
      }
      case mjGEOM_SPHERE:
        return Put(Kind::kEllipsoid, pose, Vector3d::Constant(2 * half[0]));
      case mjGEOM_ELLIPSOID:
        return Put(Kind::kEllipsoid, pose, 2 * half);
      case mjGEOM_BOX:
        return Put(Kind::kBox, pose, 2 * half);
      case mjGEOM_CYLINDER:
        return Put(Kind::kCylinder, pose, round);
      case mjGEOM_CAPSULE:
        Put(Kind::kCylinder, pose, round);
        for (const double end : {-half[1], half[1]}) {
          Put(Kind::kEllipsoid, pose * Translation3d(0, 0, end), Vector3d::Constant(2 * half[0]));
        }
        return;
      case mjGEOM_HFIELD:
        return PutTriangles(pose, Heights(model_.geom_dataid[geom]));
      case mjGEOM_MESH:
        return PutTriangles(pose, Mesh(model_.geom_dataid[geom]));
      default:
        return;  // what MuJoCo draws only to show something
    }
  }

  void PutTriangles(const Isometry3d& X_WS, std::vector<Vector3d> corners) {
    if (corners.empty()) return;
    Put(Kind::kTriangles, X_WS, Vector3d::Ones());
    shapes_.back().corners = std::move(corners);
  }

  // The places along one side of a field that are shown: every `step`th, and the last.
  static std::vector<int> Places(int count, int step) {
    std::vector<int> places;
    for (int place = 0; place < count - 1; place += step) places.push_back(place);
    places.push_back(count - 1);
    return places;
  }

  std::vector<Vector3d> Heights(int field) const {
    const int rows = model_.hfield_nrow[field], columns = model_.hfield_ncol[field];
    if (rows < 2 || columns < 2) return {};
    int step = 1;
    const auto squares = [&](int side) { return (side - 2) / step + 1; };
    while (std::ptrdiff_t{squares(rows)} * squares(columns) > kMostSquares) ++step;
    const mjtNum* const size = model_.hfield_size + 4 * field;
    const float* const heights = model_.hfield_data + model_.hfield_adr[field];
    const auto corner = [&](int row, int column) {
      return Vector3d(size[0] * (2.0 * column / (columns - 1) - 1),
                      size[1] * (2.0 * row / (rows - 1) - 1),
                      size[2] * double{heights[std::ptrdiff_t{row} * columns + column]});
    };
    const std::vector<int> ys = Places(rows, step), xs = Places(columns, step);
    std::vector<Vector3d> corners;
    for (std::size_t j = 0; j + 1 < ys.size(); ++j) {
      for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
        const Vector3d a = corner(ys[j], xs[i]), b = corner(ys[j], xs[i + 1]),
                       c = corner(ys[j + 1], xs[i + 1]), d = corner(ys[j + 1], xs[i]);
        corners.insert(corners.end(), {a, b, c, a, c, d});
      }
    }
    return corners;
  }

  std::vector<Vector3d> Mesh(int mesh) const {
    const float* const vertices =
        model_.mesh_vert + 3 * static_cast<std::ptrdiff_t>(model_.mesh_vertadr[mesh]);
    const int* const faces =
        model_.mesh_face + 3 * static_cast<std::ptrdiff_t>(model_.mesh_faceadr[mesh]);
    std::vector<Vector3d> corners;
    for (std::ptrdiff_t i = 0; i < 3 * std::ptrdiff_t{model_.mesh_facenum[mesh]}; ++i) {
      corners.emplace_back(
          Eigen::Map<const Eigen::Vector3f>(vertices + 3 * std::ptrdiff_t{faces[i]})
              .cast<double>());
    }
    return corners;
  }

  const mjModel& model_;
  DataHandle data_;
  SceneShape shape_;  // what all shapes of a geom have
  std::vector<SceneShape> shapes_;
};

}  // namespace

std::vector<SceneShape> SceneShapesOf(const mjModel& model, const std::string& base) {
  return ShapesMaker(model).Make(mj_name2id(&model, mjOBJ_BODY, base.c_str()));
}

}  // namespace understudy::mjcf
