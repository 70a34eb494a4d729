// What a Go2's camera sees of an AprilTag and a checkerboard, through its lens.
#include <cmath>
#include <cstdint>
#include <string>

#include <Eigen/Core>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include "assembly/make_world.h"
#include "assembly/sight_model.h"
#include "config/load.h"
#include "mjcf/compile.h"
#include "mjcf/eigen_views.h"
#include "objects/april_tags.h"
#include "robot/lens.h"
#include "terrain/image.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"
#include "viewer/robot_eyes.h"

namespace understudy::viewer {
namespace {

class PrintedObjectsTest : public test::MujocoTest {
 protected:
  // A Go2 that stands looks at these things.
  void LookAt(const std::string& things) {
    config::Config config =
        config::LoadConfig({.robot = "go2", .sets = {"start.pose=standing", "objects=" + things}},
                           UNDERSTUDY_SOURCE_DIR);
    assembly::MakePhysics(&config);
    model_ = mjcf::CopyOf(*assembly::SightModel(config).Get());
    data_ = mjcf::MakeData(*model_);
    data_->qpos[2] = 0.32;  // m: its base, about as it stands
    mj_kinematics(model_.get(), data_.get());
    mj_comPos(model_.get(), data_.get());
    mj_camlight(model_.get(), data_.get());
    camera_ = config.robots[0].spec.cameras.at(0);
    SceneState state;
    state.qpos.assign(data_->qpos, data_->qpos + model_->nq);
    RobotEyes eyes(mjcf::CopyOf(*model_), "");
    picture_ = eyes.See(camera_, 1, state);
  }
  // Where a point [m] of the world is in the picture, by the place of the camera and its lens.
  Eigen::Vector2d PixelOf(const Eigen::Vector3d& p_WP) const {
    const int camera = mj_name2id(model_.get(), mjOBJ_CAMERA, camera_.name.c_str());
    const mjcf::RotationView R_WC(data_->cam_xmat + 9 * camera);  // x right, y up, z back
    const Eigen::Vector3d p_CP =
        R_WC.transpose() * (p_WP - mjcf::Vector(data_->cam_xpos + 3 * camera));
    return robot::PixelOf(camera_, {p_CP.x() / -p_CP.z(), p_CP.y() / p_CP.z()});
  }
  bool IsDark(const Eigen::Vector2d& at) const {
    const auto column = static_cast<int>(std::lround(at.x()));
    const auto row = static_cast<int>(std::lround(at.y()));
    EXPECT_TRUE(column >= 0 && column < picture_.width && row >= 0 && row < picture_.height);
    return picture_.rgb[3 * static_cast<std::size_t>(row * picture_.width + column) + 1] < 70;
  }

  mjcf::ModelHandle model_;
  mjcf::DataHandle data_;
  robot::CameraSpec camera_;
  Image picture_;
};

// It looks along -x with its front at x = 1.2 m - 5 mm, its middle 0.35 m over the ground. `right`
// and `up` are of who looks at it.
Eigen::Vector3d OnBoard(double right, double up) { return {1.1945, -right, 0.35 + up}; }

TEST_F(PrintedObjectsTest, ShowTheCornersOfATagWithinTwoPixels) {
  LookAt("[{kind: tag, id: 23, pos: [1.2, 0, 0.25], yaw: 3.14159265358979}]");
  const Eigen::Vector2d middle = PixelOf(OnBoard(0, 0));
  for (const double right : {-0.08, 0.08}) {
    for (const double up : {-0.08, 0.08}) {
      const Eigen::Vector2d corner = PixelOf(OnBoard(right, up));
      const Eigen::Vector2d inwards((middle - corner).cwiseSign());
      EXPECT_TRUE(IsDark(corner + 2 * inwards)) << right << ", " << up;
      EXPECT_FALSE(IsDark(corner - 2 * inwards)) << right << ", " << up;
      EXPECT_FALSE(IsDark(corner + 2 * Eigen::Vector2d(inwards.x(), -inwards.y())));
      EXPECT_FALSE(IsDark(corner + 2 * Eigen::Vector2d(-inwards.x(), inwards.y())));
    }
  }
  const objects::CellGrid grid = objects::AprilTag(23);
  for (int row = 0; row < 8; ++row) {
    for (int column = 0; column < 8; ++column) {
      const Eigen::Vector3d cell = OnBoard(0.02 * (column - 3.5), -0.02 * (row - 3.5));
      EXPECT_EQ(IsDark(PixelOf(cell)),
                grid[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)])
          << row << ", " << column;
    }
  }
}

TEST_F(PrintedObjectsTest, ShowTheInnerCornersOfACheckerboardWithinTwoPixels) {
  LookAt("[{kind: checkerboard, pos: [1.2, 0, 0.23], yaw: 3.14159265358979}]");
  for (int row = 1; row < 7; ++row) {
    for (int column = 1; column < 9; ++column) {
      const Eigen::Vector2d corner = PixelOf(OnBoard(0.03 * (column - 4.5), -0.03 * (row - 3.5)));
      const bool dark = (row + column) % 2 == 0;  // to the right and down
      EXPECT_EQ(IsDark(corner + Eigen::Vector2d(2, 2)), dark) << row << ", " << column;
      EXPECT_EQ(IsDark(corner + Eigen::Vector2d(-2, -2)), dark) << row << ", " << column;
      EXPECT_EQ(IsDark(corner + Eigen::Vector2d(2, -2)), !dark) << row << ", " << column;
      EXPECT_EQ(IsDark(corner + Eigen::Vector2d(-2, 2)), !dark) << row << ", " << column;
    }
  }
}

TEST_F(PrintedObjectsTest, ShowAPosterUprightAndNotMirrored) {
  const test::TemporaryFolder folder;
  const std::string file = folder.path() / "corner.png";
  constexpr std::uint16_t kWhite = 65535;
  terrain::WriteGreyPng(file, 2, 2, {0, kWhite, kWhite, kWhite});  // black at the top left
  LookAt("[{kind: poster, image: " + file + ", pos: [1.2, 0, 0], yaw: 3.14159265358979}]");
  for (const double right : {-0.15, 0.15}) {
    for (const double up : {-0.2, 0.2}) {
      const Eigen::Vector2d at = PixelOf(OnBoard(right, 0.4205 - 0.35 + up));
      EXPECT_EQ(IsDark(at), right < 0 && up > 0) << right << ", " << up;
    }
  }
}

}  // namespace
}  // namespace understudy::viewer
