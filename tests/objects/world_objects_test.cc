// Objects in the world of a robot: requests, conditions, resets, sensors, robots that share them.
#include <cmath>

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "assembly/sight_model.h"
#include "base/errors.h"
#include "config/load.h"
#include "perception/ray_caster.h"
#include "schema/yaml_document.h"
#include "script/script.h"
#include "tests/emulator/emulator_test.h"

namespace understudy::emulator {
namespace {

using testing::HasSubstr;

class WorldObjectsTest : public EmulatorTest {
 protected:
  // A robot of config/robots, or several, in a world with these objects.
  void Make(const std::string& objects, std::vector<std::string> sets = {},
            const std::vector<std::string>& others = {}) {
    sets.push_back("objects=" + objects);
    config_ =
        config::LoadConfig({.robot = "go2", .others = others, .sets = sets}, UNDERSTUDY_SOURCE_DIR);
    world_ = MakeIn(assembly::MakePhysics(&config_).world, &port_, &inbox_);
  }
  Eigen::Vector3d At(const char* name) const {
    const auto position = world_->physics().ObjectPosition(*world_->physics().FindObject(name));
    return {position[0], position[1], position[2]};
  }
  static std::string WhyNot(const std::string& objects) {
    config::Config config =
        config::LoadConfig({.robot = "go2", .sets = {"objects=" + objects}}, UNDERSTUDY_SOURCE_DIR);
    try {
      assembly::MakePhysics(&config);
    } catch (const ModelError& error) {
      return error.what();
    }
    return "";
  }
};

constexpr char kCubeOnATable[] =
    "[{kind: table, pos: [1, 0, 0]}, {kind: cube, pos: [0.9, 0.2, 0.75]}]";

TEST_F(WorldObjectsTest, LiesOnItsTable) {
  Make(kCubeOnATable);
  Tick(300);
  EXPECT_NEAR(At("cube").z(), 0.775, 2e-3);
  EXPECT_EQ(world_->physics().objects().size(), 1U);
}

TEST_F(WorldObjectsTest, IsPutElsewhereByARequest) {
  Make(kCubeOnATable);
  Tick(10);
  EXPECT_EQ(Answered("object", {{"object", "cube"}, {"pos", {2, 1, 0.5}}, {"yaw", 1}}), "");
  EXPECT_NEAR(At("cube").x(), 2, 1e-9);
  EXPECT_NEAR(At("cube").y(), 1, 1e-9);
  EXPECT_NEAR(At("cube").z(), 0.525, 1e-4) << "its underside is there";
  EXPECT_NEAR(world_->physics().ObjectPosition(*world_->physics().FindObject("cube"))[6],
              std::sin(0.5), 1e-6);
  Tick(1000);
  EXPECT_NEAR(At("cube").z(), 0.025, 2e-3) << "it has fallen to the floor";
}

TEST_F(WorldObjectsTest, IsPutDownAtRest) {
  Make("[{kind: ball, pos: [2, 0, 3]}]");
  Tick(500);
  EXPECT_EQ(Answered("object", {{"object", "ball"}, {"pos", {2, 0, 1}}}), "");
  const physics::LooseBody* const ball = world_->physics().FindObject("ball");
  EXPECT_NEAR(world_->physics().ObjectVelocity(*ball)[2], -9.81e-3, 1e-4);
}

TEST_F(WorldObjectsTest, IsFoundByItsNameOnly) {
  Make(kCubeOnATable);
  EXPECT_EQ(Answered("object", {{"object", "cub"}, {"pos", {0, 0, 1}}}),
            "the scene has no object 'cub'; did you mean 'cube'? (valid: cube)");
  EXPECT_THAT(Answered("object", {{"object", "table"}, {"pos", {0, 0, 1}}}),
              HasSubstr("no object 'table'"))
      << "it is fixed";
  Make("[]");
  EXPECT_EQ(Answered("object", {{"object", "cube"}, {"pos", {0, 0, 1}}}),
            "the scene has no objects");
}

TEST_F(WorldObjectsTest, IsPushedByARequest) {
  Make("[{kind: crate, pos: [2, 0, 0]}]");
  Tick(100);
  EXPECT_EQ(Answered("push", {{"body", "crate"}, {"force", {40, 0, 0}}, {"for", 0.5}}), "");
  Tick(600);
  EXPECT_GT(At("crate").x(), 2.05);
}

TEST_F(WorldObjectsTest, ReturnsToItsPlaceWithTheRobot) {
  Make(kCubeOnATable);
  Answered("object", {{"object", "cube"}, {"pos", {2, 1, 0}}});
  EXPECT_EQ(Answered("reset"), "");
  EXPECT_NEAR(At("cube").x(), 0.9, 1e-6);
  EXPECT_NEAR(At("cube").z(), 0.775, 1e-4);
}

TEST_F(WorldObjectsTest, StopsARobotThatWouldWalkThrough) {
  for (const bool blocked : {false, true}) {
    Make(blocked ? "[{kind: crate, pos: [0.8, 0, 0], mass: 400}]" : "[]", {"start.pose=standing"});
    Ask("remote.sticks", {{"ly", 0.6}, {"for", 4}});
    Tick(4500);
    const double x = world_->physics().robot().base().p_WB.x();
    if (blocked) {
      EXPECT_LT(x, 0.45);
    } else {
      EXPECT_GT(x, 0.8);
    }
  }
}

TEST_F(WorldObjectsTest, IsPushedAsideByARobotThatWalks) {
  Make("[{kind: ball, pos: [0.8, 0.15, 0]}]", {"start.pose=standing"});  // before a leg
  Ask("remote.sticks", {{"ly", 0.6}, {"for", 4}});
  Tick(4500);
  EXPECT_GT((At("ball") - Eigen::Vector3d(0.8, 0.15, 0.11)).head<2>().norm(), 0.3);
}

TEST_F(WorldObjectsTest, IsMetByRays) {
  Make("[{kind: crate, pos: [2, 0, 0]}]");
  const physics::MujocoWorld& physics = world_->physics();
  perception::RayCaster scene(physics.model(), physics.data());
  const perception::Ray ray{.origin = {1, 0, 0.3}, .direction = {1, 0, 0}};
  EXPECT_NEAR(scene.Cast(ray).distance, 0.8, 1e-6);
  Answered("object", {{"object", "crate"}, {"pos", {3, 0, 0}}});
  scene.Follow(1, physics.data());
  EXPECT_NEAR(scene.Cast(ray).distance, 1.8, 1e-3);
}

TEST_F(WorldObjectsTest, IsOneForAllRobotsOfTheWorld) {
  Make("[{kind: ball, pos: [1, 1, 0]}]", {}, {"go2"});
  EXPECT_EQ(world_->robot_count(), 2U);
  EXPECT_EQ(world_->physics().objects().size(), 1U);
  Tick(100);
  EXPECT_EQ(Answered("object", {{"robot", 1}, {"object", "ball"}, {"pos", {4, 0, 0}}}), "");
  EXPECT_EQ(Answered("reset"), "");
  EXPECT_NEAR(At("ball").x(), 4, 1e-2) << "one robot alone is put back";
  EXPECT_EQ(Answered("reset", {{"all", true}}), "");
  EXPECT_NEAR(At("ball").x(), 1, 1e-3);
}

TEST_F(WorldObjectsTest, HasTheSamePlaceInWhatViewersDraw) {
  Make(kCubeOnATable);
  const auto sight = assembly::SightModel(config_).Get();
  const mjModel& model = world_->physics().model();
  ASSERT_EQ(sight->nq, model.nq);
  const int joint = mj_name2id(sight.get(), mjOBJ_JOINT, "cube");
  ASSERT_GE(joint, 0);
  EXPECT_EQ(static_cast<std::size_t>(sight->jnt_qposadr[joint]),
            world_->physics().FindObject("cube")->q);
}

TEST_F(WorldObjectsTest, HasNoNameOfTheRobots) {
  EXPECT_THAT(
      WhyNot("[{kind: cup}, {name: base_link}]"),
      testing::AllOf(HasSubstr("objects.1.name: "), HasSubstr("go2.xml has a body 'base_link'"),
                     HasSubstr("expected another name")));
}

TEST_F(WorldObjectsTest, IsWaitedForByScripts) {
  Make(kCubeOnATable);
  signals::Names names = signals::RunningNames(config_.robots[0].spec);
  names.objects = objects::MovingNamesOf(config_.objects);
  const std::string events =
      "[{at: 0.1, object: {object: cube, pos: [2, 0, 1]}}, {at: 0.05, clamp: on, when: "
      "object.height(cube) > 0.9 and object.x(cube) > 1.9 and object.y(cube) < 0.1 and "
      "object.tilt(cube) < 1 deg and object.speed(cube) < 0.1}]";
  script::Play(script::ReadEvents(schema::ParseYaml(events, "s"), names), world_.get());
  Tick(99);
  EXPECT_FALSE(world_->status(0).clamped);
  Tick(10);
  EXPECT_TRUE(world_->status(0).clamped);
}

TEST_F(WorldObjectsTest, IsAskedForOnlyByScriptsOfWorldsThatHaveIt) {
  Make("[]");
  const script::Script script =
      script::ReadEvents(schema::ParseYaml("[{when: object.height(cube) > 1, clamp: on}]", "s"),
                         signals::RunningNames());
  try {
    script::Play(script, world_.get());
    ADD_FAILURE() << "it was played";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "s:1: when: object.height(cube): the scene has no object 'cube'");
  }
}

}  // namespace
}  // namespace understudy::emulator
