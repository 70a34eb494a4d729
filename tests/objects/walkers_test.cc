// People and carts in the world of a robot.
#include <cmath>
#include <cstring>

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "assembly/sight_model.h"
#include "config/load.h"
#include "objects/walk.h"
#include "perception/nearest_obstacle.h"
#include "perception/ray_caster.h"
#include "schema/yaml_document.h"
#include "script/script.h"
#include "tests/emulator/emulator_test.h"

namespace understudy::emulator {
namespace {

using testing::HasSubstr;

class WalkersTest : public EmulatorTest {
 protected:
  void Make(const std::string& objects, std::vector<std::string> sets = {}) {
    sets.push_back("objects=" + objects);
    config_ = config::LoadConfig({.robot = "go2", .sets = sets}, UNDERSTUDY_SOURCE_DIR);
    world_ = MakeIn(assembly::MakePhysics(&config_).world, &port_, &inbox_);
  }
  Eigen::Vector3d At(const char* name) const {
    const auto position = world_->physics().ObjectPosition(*world_->physics().FindObject(name));
    return {position[0], position[1], position[2]};
  }
  std::vector<double> State() const {
    const mjModel& model = world_->physics().model();
    const mjData& data = world_->physics().data();
    std::vector<double> state(data.qpos, data.qpos + model.nq);
    state.insert(state.end(), data.qvel, data.qvel + model.nv);
    return state;
  }

  // Whether what is called so touches anything.
  bool Touches(const char* name) const {
    const mjModel& model = world_->physics().model();
    const mjData& data = world_->physics().data();
    const int body = world_->physics().FindBody(name);
    const auto is_of = [&](int geom) { return model.body_rootid[model.geom_bodyid[geom]] == body; };
    return std::any_of(data.contact, data.contact + data.ncon, [&](const mjContact& contact) {
      return is_of(contact.geom1) || is_of(contact.geom2);
    });
  }
};

// 1.4 m/s along +x, out of the robot's way.
constexpr char kPasses[] = "[{kind: person, pos: [-2, 3, 0], path: [{to: [5, 3]}]}]";

TEST_F(WalkersTest, WalkAlongTheirPath) {
  Make(kPasses);
  EXPECT_NEAR(At("person").x(), -2, 1e-9);
  Tick(1000);
  EXPECT_NEAR(At("person").x(), -0.6, 1e-6);
  EXPECT_NEAR(At("person").y(), 3, 1e-9);
  EXPECT_NEAR(At("person").z(), 1.75 / 2, 1e-9);
  EXPECT_NEAR(world_->physics().ObjectVelocity(*world_->physics().FindObject("person"))[0], 1.4,
              1e-9);
}

TEST_F(WalkersTest, SwingTheirLegs) {
  Make(kPasses);
  const mjModel& model = world_->physics().model();
  const int left = mj_name2id(&model, mjOBJ_JOINT, "person/left");
  const int right = mj_name2id(&model, mjOBJ_JOINT, "person/right");
  ASSERT_TRUE(left >= 0 && right >= 0);
  Tick(1250);  // 1.75 m: in the middle of the third step
  const mjtNum* const q = world_->physics().data().qpos;
  EXPECT_NEAR(q[model.jnt_qposadr[left]], std::atan(0.35 / 0.82), 1e-6);
  EXPECT_NEAR(q[model.jnt_qposadr[right]], -std::atan(0.35 / 0.82), 1e-6);
}

TEST_F(WalkersTest, StandStillWithoutAPath) {
  Make("[{kind: person, pos: [1, 3, 0]}]");
  EXPECT_TRUE(world_->physics().objects().empty()) << "as a table";
}

TEST_F(WalkersTest, PushWhatIsInTheirWayAndAreNotPushed) {
  Make("[{kind: cart, pos: [-2, 3, 0], path: [{to: [5, 3]}]}, {kind: crate, pos: [0, 3, 0]}]");
  Tick(4000);
  EXPECT_NEAR(At("cart").x(), -2 + 0.8 * 4, 1e-6);
  EXPECT_NEAR(At("cart").y(), 3, 1e-9);
  EXPECT_GT(At("crate").x(), At("cart").x() + 0.5) << "it is before the cart";
}

TEST_F(WalkersTest, PushARobotWithoutHarmToTheWorld) {
  for (const char* const kind : {"person", "cart"}) {
    Make(std::string("[{kind: ") + kind + ", name: it, pos: [0, -2, 0], path: [{to: [0, 3]}]}]",
         {"start.pose=standing"});
    Tick(500);
    EXPECT_NEAR(world_->physics().robot().base().p_WB.y(), 0, 0.05);
    Tick(4000);
    EXPECT_GT(std::abs(world_->physics().robot().base().p_WB.y()) +
                  std::abs(world_->physics().robot().base().p_WB.x()),
              0.2)
        << kind;
    EXPECT_NEAR(At("it").x(), 0, 1e-9) << kind;
    EXPECT_EQ(world_->status(0).divergences, 0U) << kind;
  }
}

// A contact that draws no surface with it holds a box on it where it is in the world.
TEST_F(WalkersTest, CarryWhatLiesOnThem) {
  Make("[{kind: cart, pos: [-2, 3, 0], path: [{to: [5, 3]}]}, {kind: cube, pos: [-1.9, 3, 0.72]}]");
  Tick(3000);
  EXPECT_NEAR(At("cube").x() - At("cart").x(), 0.1, 0.25) << "it slid at the sudden start";
  EXPECT_NEAR(At("cube").z(), 0.745, 0.01);
}

TEST_F(WalkersTest, MeetNeitherGroundNorWhatIsFixedNorEachOther) {
  Make(
      "[{kind: person, pos: [-1, 3, -0.02], path: [{to: [5, 3]}]}, {kind: table, pos: [0, 3, 0]}, "
      "{kind: child, pos: [1, 3, 0], path: [{to: [-5, 3]}]}, {kind: person, pos: [0.5, 3, 0]}]");
  for (int i = 0; i < 2000; ++i) {
    Tick();
    ASSERT_FALSE(Touches("person")) << i;
    ASSERT_FALSE(Touches("child")) << i;
  }
}

TEST_F(WalkersTest, BeginAgainWithAReset) {
  Make(kPasses);
  Tick(2000);
  EXPECT_EQ(Answered("reset"), "");
  EXPECT_NEAR(At("person").x(), -2, 3e-3);
  Tick(999);
  EXPECT_NEAR(At("person").x(), -0.6, 3e-3);
}

TEST_F(WalkersTest, AreMovedByNoRequest) {
  Make(kPasses);
  EXPECT_EQ(Answered("object", {{"object", "person"}, {"pos", {0, 0, 0}}}),
            "'person' walks along its path; reset puts it back at the start");
  EXPECT_EQ(Answered("push", {{"body", "person"}, {"force", {40, 0, 0}}, {"for", 0.5}}),
            "'person' walks along its path; no force moves it");
  EXPECT_EQ(Answered("push", {{"body", "person/left"}, {"force", {40, 0, 0}}, {"for", 0.5}}),
            "'person' walks along its path; no force moves it");
  EXPECT_THAT(Answered("object", {{"object", "persn"}, {"pos", {0, 0, 0}}}),
              HasSubstr("the scene has no objects"));
}

TEST_F(WalkersTest, AreMetByRaysWhereTheyAre) {
  Make("[{kind: cart, pos: [2, 0, 0], path: [{to: [4, 0]}]}]");
  perception::RayCaster scene(world_->physics().model(), world_->physics().data());
  const perception::Ray ray{.origin = {1, 0, 0.5}, .direction = {1, 0, 0}};
  EXPECT_NEAR(scene.Cast(ray).distance, 1 + 0.05 - 0.35, 1e-6);
  Tick(1001);
  scene.Follow(1, world_->physics().data());
  EXPECT_NEAR(scene.Cast(ray).distance, 1.8 + 0.05 - 0.35, 1e-3);
}

TEST_F(WalkersTest, AreDrawnWhereTheyAre) {
  Make(
      "[{kind: cup, pos: [3, 0, 0]}, {kind: person, pos: [-2, 3, 0], path: [{to: [5, 3]}], seed: "
      "4}]");
  const auto sight = assembly::SightModel(config_).Get();
  ASSERT_EQ(sight->nq, world_->physics().model().nq);
  const int joint = mj_name2id(sight.get(), mjOBJ_JOINT, "person");
  ASSERT_GE(joint, 0);
  const auto at = static_cast<std::size_t>(sight->jnt_qposadr[joint]);
  EXPECT_EQ(at, world_->physics().FindObject("person")->q);
  EXPECT_NEAR(sight->qpos0[at], At("person").x(), 1e-6) << "as it begins";
}

TEST_F(WalkersTest, AreWaitedForByScripts) {
  Make(kPasses);
  signals::Names names = signals::RunningNames(config_.robots[0].spec);
  names.objects = objects::MovingNamesOf(config_.objects);
  script::Play(
      script::ReadEvents(schema::ParseYaml("[{at: 0, clamp: on, when: object.x(person) > -1.3 and "
                                           "object.speed(person) > 1.39}]",
                                           "s"),
                         names),
      world_.get());
  Tick(495);
  EXPECT_FALSE(world_->status(0).clamped);
  Tick(10);
  EXPECT_TRUE(world_->status(0).clamped);
}

// A Go2 that is to walk through a gap between posts meets a person in it, who goes on (config/
// scenarios/crossing.yaml).
TEST_F(WalkersTest, StopARobotThatAvoidsObstaclesUntilTheyHaveGone) {
  std::string objects =
      "[{kind: person, pos: [4, -4, 0], path: [{to: [4, 0]}, {to: [3.1, 0], wait: 3}, {to: [4, "
      "0]}, "
      "{to: [4, 5]}], then: stay}";
  for (const char* const y : {"0.65", "1.25", "1.85", "-0.65", "-1.25", "-1.85"}) {
    objects += std::string(", {kind: pedestal, pos: [3, ") + y + ", 0]}";
  }
  config_ = config::LoadConfig(
      {.robot = "go2", .sets = {"start.pose=standing", "objects=" + objects + "]"}},
      UNDERSTUDY_SOURCE_DIR);
  world_ = MakeIn(assembly::MakePhysics(&config_).world, &port_, &inbox_, &services_);
  services_.Call([](authority::MotorOwner* owner) { owner->onboard().avoids = true; });
  perception::NearestObstacle nearest(world_->physics(), 0);
  double least = 10;
  const auto walk_until = [&](double seconds) {
    while (world_->time() < seconds) {
      services_.Call([](authority::MotorOwner* owner) {
        owner->Ask(authority::goal::Move{.vx = 0.5, .hold = 1, .avoids = true});
      });
      Tick(100);
      least = std::min(least, nearest.Measure(world_->step(), world_->physics().data()));
    }
    return world_->physics().robot().base().p_WB.x();
  };
  Tick(1000);
  const double before = walk_until(7.4);
  EXPECT_GT(before, 1.9) << "it came up to the person";
  EXPECT_NEAR(walk_until(8.6), before, 0.1) << "it waits";
  EXPECT_GT(least, 0.2);
  EXPECT_GT(walk_until(18), 3.8) << "it walked on";
}

TEST_F(WalkersTest, AreTheSameBitByBitInEachRun) {
  const auto run = [this] {
    Make(
        "[{kind: person, pos: [0, -1, 0], path: [{to: [0.2, 1]}], seed: 3}, {kind: crate, pos: "
        "[0, 1.5, 0]}]",
        {"start.pose=standing"});
    Tick(1500);
    return State();
  };
  const std::vector<double> first = run();
  EXPECT_EQ(run(), first);
}

}  // namespace
}  // namespace understudy::emulator
