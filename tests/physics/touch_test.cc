#include "physics/touch.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "physics/world.h"
#include "physics/world_model.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::physics {
namespace {

using testing::Each;

constexpr double kWeight = 9.81;  // N

// A slab that is fixed in the world, with a pad of two rows of four cells on its top, 40 x 20 mm.
constexpr char kSlabWithSkin[] = R"(
<mujoco>
  <worldbody>
    <body name="hand">
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <geom type="box" size="0.05 0.05 0.01"/>
      <site name="skin" type="box" %s size="0.02 0.01 0.001"/>
    </body>
  </worldbody>
</mujoco>)";

// A ball of 1 kg that lies on the middle of the third cell of the first row.
constexpr char kBallOnSlab[] = R"(
<mujoco>
  <worldbody>
    <body name="ball" pos="0.005 0.005 0.03">
      <freejoint/>
      <geom type="sphere" size="0.02" mass="1" solref="0.005 1"/>
    </body>
  </worldbody>
</mujoco>)";

constexpr char kOnTop[] = R"(pos="0 0 0.01")";

class TouchTest : public test::MujocoTest {
 protected:
  // Rests the ball on a slab whose site has these attributes and reads the cells.
  void Rest(const std::string& site, const std::vector<robot::PadSpec>& pads) {
    const test::TemporaryFolder folder;
    std::string text = kSlabWithSkin;
    text.replace(text.find("%s"), 2, site);
    robot::RobotSpec spec;
    spec.base_body = spec.crane_body = "hand";
    spec.imu.site = "skin";
    spec.hands = {{.name = "bare"}, {.name = "felt", .pads = pads, .touch = {.spread = 0.004}}};
    World world(LoadWorldModel({{spec, folder.Write("slab.xml", text)}},
                               folder.Write("scene.xml", kBallOnSlab), 0.001),
                {{spec}});
    for (int i = 0; i < 2000; ++i) {
      world.BeginStep();
      ASSERT_EQ(world.EndStep(), StepHealth::kFine);
    }
    cells_.assign(8 * pads.size(), -1.0F);
    world.robot().ReadTouch(cells_);
    world.robot().HandForces(forces_);
  }

  std::vector<float> cells_;
  std::vector<double> forces_{-1, -1};
};

TEST_F(TouchTest, ACellFeelsAllOfWhatSitsOnItAndItsNeighboursLessByDistance) {
  Rest(kOnTop, {{.site = "skin", .rows = 2, .columns = 4}});
  EXPECT_NEAR(cells_[2], kWeight, 0.05);
  EXPECT_NEAR(cells_[1] / cells_[2], 0.0439, 0.001) << "exp(-(10/4)²/2)";
  EXPECT_NEAR(cells_[3] / cells_[2], 0.0439, 0.001);
  EXPECT_NEAR(cells_[6] / cells_[2], 0.0439, 0.001) << "the second row is 10 mm towards -y";
  EXPECT_NEAR(cells_[4] / cells_[2], 1.6e-7, 1e-7);
}

TEST_F(TouchTest, WhatPressesOnTheBackIsFeltByNoCellButPressesOnTheHand) {
  Rest(R"(pos="0 0 0.01" quat="0 1 0 0")", {{.site = "skin", .rows = 2, .columns = 4}});
  EXPECT_THAT(cells_, Each(0.0F));
  EXPECT_NEAR(forces_[1], kWeight, 0.05);
}

TEST_F(TouchTest, WhatPressesFurtherThanItsReachFromTheSkinIsNotFelt) {
  Rest(R"(pos="0 0 0.004")", {{.site = "skin", .rows = 2, .columns = 4}});
  EXPECT_NEAR(cells_[2], kWeight, 0.05) << "6 mm over the skin";
  Rest(R"(pos="0 0 0")", {{.site = "skin", .rows = 2, .columns = 4}});
  EXPECT_THAT(cells_, Each(0.0F)) << "10 mm";
}

TEST_F(TouchTest, PadsKeepTheirPlaceBehindThoseThatTheModelLacks) {
  Rest(kOnTop, {{.rows = 2, .columns = 4},
                {.site = "none", .rows = 2, .columns = 4},
                {.site = "skin", .rows = 2, .columns = 4}});
  EXPECT_NEAR(cells_[16 + 2], kWeight, 0.05);
  cells_.resize(16);
  EXPECT_THAT(cells_, Each(0.0F));
}

TEST_F(TouchTest, OnlyHandsWithPadsTellAForce) {
  Rest(kOnTop, {{.site = "skin", .rows = 2, .columns = 4}});
  EXPECT_EQ(forces_[0], 0);
  EXPECT_NEAR(forces_[1], kWeight, 0.05);
  Rest(kOnTop, {{.rows = 2, .columns = 4}});
  EXPECT_THAT(cells_, Each(0.0F));
  EXPECT_EQ(forces_[1], 0);
}

}  // namespace
}  // namespace understudy::physics
