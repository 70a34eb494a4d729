#include "robot/lens.h"

namespace understudy::robot {
namespace {

struct Bend {
  double radial;             // factor of the direction
  Eigen::Vector2d sideways;  // in addition
};

Bend BendAt(const CameraSpec& camera, const Eigen::Vector2d& d) {
  const auto& [k1, k2, p1, p2] = camera.distortion;
  const double r2 = d.squaredNorm();
  const double xy = 2 * d.x() * d.y();
  return {.radial = 1 + r2 * (k1 + r2 * k2),
          .sideways = {p1 * xy + p2 * (r2 + 2 * d.x() * d.x()),
                       p1 * (r2 + 2 * d.y() * d.y()) + p2 * xy}};
}

}  // namespace

Eigen::Vector2d PixelOf(const CameraSpec& camera, const Eigen::Vector2d& direction) {
  const Bend bend = BendAt(camera, direction);
  const Eigen::Vector2d bent = bend.radial * direction + bend.sideways;
  return {camera.centre[0] + camera.focal[0] * bent.x(),
          camera.centre[1] + camera.focal[1] * bent.y()};
}

// By iteration, as OpenCV does it: the bend changes slowly with the direction.
Eigen::Vector2d DirectionOf(const CameraSpec& camera, const Eigen::Vector2d& pixel) {
  constexpr int kMostRounds = 60;
  constexpr double kClose = 1e-8;  // 1e-5 of a pixel
  const Eigen::Vector2d bent((pixel.x() - camera.centre[0]) / camera.focal[0],
                             (pixel.y() - camera.centre[1]) / camera.focal[1]);
  Eigen::Vector2d direction = bent;
  for (int i = 0; i < kMostRounds; ++i) {
    const Bend bend = BendAt(camera, direction);
    const Eigen::Vector2d next = (bent - bend.sideways) / bend.radial;
    const bool close = (next - direction).cwiseAbs().maxCoeff() < kClose;
    direction = next;
    if (close) break;
  }
  return direction;
}

Eigen::Vector2d ReachOf(const CameraSpec& camera) {
  constexpr int kPieces = 64;  // of an edge
  Eigen::Vector2d reach(0, 0);
  const double width = camera.width, height = camera.height;
  for (int i = 0; i <= kPieces; ++i) {
    const double u = width * i / kPieces, v = height * i / kPieces;
    for (const Eigen::Vector2d& corner : {Eigen::Vector2d(u, 0), Eigen::Vector2d(u, height),
                                          Eigen::Vector2d(0, v), Eigen::Vector2d(width, v)}) {
      const Eigen::Vector2d pixel = corner.array() - 0.5;
      reach = reach.cwiseMax(DirectionOf(camera, pixel).cwiseAbs());
    }
  }
  return reach;
}

}  // namespace understudy::robot
