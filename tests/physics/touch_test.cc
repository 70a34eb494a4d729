#include "physics/touch.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "physics/mujoco_world.h"
#include "physics/world_model.h"
#include "robot/hand_law.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::physics {
namespace {

using testing::DoubleNear;
using testing::Each;
using testing::ElementsAre;

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
    spec.hands = {{.name = "felt", .pads = pads, .touch = {.spread = 0.004}}};
    MujocoWorld world(LoadWorldModel({{spec, folder.Write("slab.xml", text)}},
                                     folder.Write("scene.xml", kBallOnSlab), 0.001),
                      {{spec}});
    for (int i = 0; i < 2000; ++i) {
      world.BeginStep();
      ASSERT_EQ(world.EndStep(), StepHealth::kFine);
    }
    cells_.assign(8 * pads.size(), -1.0F);
    world.robot().ReadTouch(cells_);
    force_ = 0;
    world.robot().HandForces({&force_, robot::HandNames(spec).size()});
  }

  std::vector<float> cells_;
  double force_ = 0;
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
  EXPECT_NEAR(force_, kWeight, 0.05);
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

TEST_F(TouchTest, AHandWithoutMotorsAndPadsFeelsNothing) {
  Rest(kOnTop, {{.rows = 2, .columns = 4}});
  EXPECT_THAT(cells_, Each(0.0F));
  EXPECT_EQ(force_, 0);
}

// An arm that is fixed in the world, with a palm on it, and on that a finger that a motor moves and
// one that follows.
constexpr char kHandOnArm[] = R"(
<mujoco>
  <worldbody>
    <body name="column">
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <site name="unit"/>
      <body name="arm">
        <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
        <geom name="sleeve" type="box" pos="-0.5 0 0" size="0.05 0.05 0.01"/>
        <body name="palm">
          <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
          <geom name="skin" type="box" size="0.05 0.05 0.01"/>
          <body name="thumb">
            <joint name="%s_thumb_joint" damping="1e6"/>
            <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
          </body>
          <body name="finger">
            <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
            <geom name="nail" type="box" pos="0.5 0 0" size="0.05 0.05 0.01"/>
          </body>
        </body>
      </body>
    </body>
  </worldbody>
</mujoco>)";

// What robots with such an arm, the others 3 m apart, feel of a ball of 1 kg that rests over `x`
// [m] of the first one.
std::vector<std::vector<double>> Felt(double x, const std::string& side, int robots = 1) {
  const test::TemporaryFolder folder;
  std::string text = kHandOnArm;
  text.replace(text.rfind("%s"), 2, side);
  std::string ball = kBallOnSlab;
  ball.replace(ball.find("0.005"), 5, std::to_string(x));
  robot::RobotSpec spec;
  spec.base_body = spec.crane_body = "column";
  spec.imu.site = "unit";
  spec.hands = {{.name = "gripper", .motors = {{.joint = side + "_thumb_joint"}}}};
  std::vector<PlacedRobot> placed;
  for (int i = 0; i < robots; ++i) {
    placed.push_back({.spec = spec,
                      .file = folder.Write("arm.xml", text),
                      .prefix = robots == 1 ? "" : "robot" + std::to_string(i) + "/",
                      .y = 3.0 * i});
  }
  MujocoWorld world(LoadWorldModel(placed, folder.Write("scene.xml", ball), 0.001), placed);
  for (int i = 0; i < 2000; ++i) {
    world.BeginStep();
    EXPECT_EQ(world.EndStep(), StepHealth::kFine);
  }
  std::vector<std::vector<double>> forces;
  for (int i = 0; i < robots; ++i) {
    forces.emplace_back(robot::HandNames(spec).size(), -1.0);
    world.robot(static_cast<std::size_t>(i)).HandForces(forces.back());
  }
  return forces;
}

TEST_F(TouchTest, TheForceOnAHandIsThatOnTheLinkThatBearsItsFingersAndOnAllThatHangsOnIt) {
  const auto weight = DoubleNear(kWeight, 0.05);
  EXPECT_THAT(Felt(0.005, "left"), ElementsAre(ElementsAre(weight))) << "on the palm";
  EXPECT_THAT(Felt(0.505, "left"), ElementsAre(ElementsAre(weight))) << "on a finger";
  EXPECT_THAT(Felt(-0.495, "left"), ElementsAre(ElementsAre(0))) << "on the sleeve";
}

TEST_F(TouchTest, TheForceIsThatOnTheHandOfThisRobot) {
  EXPECT_THAT(Felt(0.005, "left", 2),
              ElementsAre(ElementsAre(DoubleNear(kWeight, 0.05)), ElementsAre(0)));
}

TEST_F(TouchTest, HandsThatShareMessagesAreTwo) {
  robot::RobotSpec spec;
  spec.hands = {{.name = "pair",
                 .motors = {{.joint = "right_thumb_joint"},
                            {.joint = "left_thumb_joint"},
                            {.joint = "left_finger_joint"}}},
                {.name = "claw", .motors = {{.joint = "lefty_joint"}}, .pads = {{.site = ""}}}};
  EXPECT_THAT(robot::HandNames(spec), ElementsAre("claw", "left", "right"));
}

}  // namespace
}  // namespace understudy::physics
