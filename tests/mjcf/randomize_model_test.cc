#include "mjcf/randomize_model.h"

#include <cmath>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "mjcf/join.h"
#include "physics/mujoco_world.h"
#include "physics/world_model.h"
#include "tests/support/fixture_robot.h"
#include "tests/support/mujoco_test.h"

namespace understudy::mjcf {
namespace {

using testing::ElementsAre;
using testing::SizeIs;

// The fixture robot with a hand, whose figures can be computed in the head: six bodies of 1 kg.
class RandomizeModelTest : public test::MujocoTest {
 protected:
  ModelHandle Load() const {
    return physics::LoadWorldModel({{spec_, spec_.model}}, test::FixtureFile("fixture_ground.xml"),
                                   0.001);
  }

  // The model with what these ranges draw; `drawn_` has what that was.
  ModelHandle Randomized(const robot::RandomizationSpec& ranges, int seed = 1) {
    ModelHandle model = Load();
    robot::Randomizer randomizer(seed);
    RandomizeModel(ranges, std::span(&spec_, 1), &randomizer, model.get());
    drawn_.clear();
    for (const robot::Drawn& drawn : randomizer.draws().values) {
      drawn_[drawn.quantity + (drawn.element.empty() ? "" : "/" + drawn.element)] = drawn.value;
    }
    return model;
  }

  int Body(const std::string& name) const { return Id(mjOBJ_BODY, name); }
  int Dof(const std::string& name) const { return plain_->jnt_dofadr[Id(mjOBJ_JOINT, name)]; }
  int Id(mjtObj type, const std::string& name) const {
    const int id = mj_name2id(plain_.get(), type, name.c_str());
    EXPECT_GE(id, 0) << name;
    return id;
  }

  // What each body, or joint, has by its name.
  std::map<std::string, double> Masses(const mjModel& model) const {
    std::map<std::string, double> masses;
    for (int body = 1; body < model.nbody; ++body) {
      masses[mj_id2name(&model, mjOBJ_BODY, body)] = model.body_mass[body];
    }
    return masses;
  }

  const robot::RobotSpec spec_ = test::FixtureRobotWithHand();
  const ModelHandle plain_ = Load();
  std::map<std::string, double> drawn_;
};

TEST_F(RandomizeModelTest, DrawsTheSameFromTheSameSeedBitForBitAndElseOtherwise) {
  const robot::RandomizationSpec ranges{.friction = {0.5, 1.5}, .mass = {0.5, 1.5}};
  const auto first = Masses(*Randomized(ranges, 1));
  EXPECT_EQ(first, Masses(*Randomized(ranges, 1)));
  EXPECT_NE(first, Masses(*Randomized(ranges, 2)));
}

TEST_F(RandomizeModelTest, DrawsTheSameWhateverElseIsDrawn) {
  const auto alone = Masses(*Randomized({.mass = {0.5, 1.5}}));
  const auto together = Masses(*Randomized({.friction = {0.5, 1.5},
                                            .mass = {0.5, 1.5},
                                            .inertia = {0.5, 1.5},
                                            .damping = {0, 2},
                                            .imu_mounting = {-0.1, 0.1}}));
  EXPECT_EQ(alone, together);
}

TEST_F(RandomizeModelTest, ScalesTheSlidingFrictionOfAllGeomsAlike) {
  const ModelHandle model = Randomized({.friction = {0.5, 0.8}});
  const double factor = drawn_.at("friction");
  EXPECT_GE(factor, 0.5);
  EXPECT_LE(factor, 0.8);
  for (int geom = 0; geom < model->ngeom; ++geom) {
    EXPECT_EQ(model->geom_friction[3 * geom], factor * plain_->geom_friction[3 * geom]);
    EXPECT_EQ(model->geom_friction[3 * geom + 1], plain_->geom_friction[3 * geom + 1]);
  }
}

TEST_F(RandomizeModelTest, ScalesTheWorldOnceAndEachOfItsRobotsByItself) {
  std::vector<physics::PlacedRobot> placed;
  std::vector<robot::RobotSpec> robots;
  for (const std::string prefix : {"a/", "b/"}) {
    placed.push_back({.spec = spec_, .file = spec_.model, .prefix = prefix});
    robots.push_back(WithPrefix(prefix, spec_));
  }
  placed[1].x = 3;
  const auto load = [&] {
    return physics::LoadWorldModel(placed, test::FixtureFile("fixture_ground.xml"), 0.001);
  };
  const ModelHandle plain = load(), model = load();
  robot::Randomizer randomizer(1);
  RandomizeModel({.friction = {0.5, 0.5},
                  .mass = {0.5, 1.5},
                  .gravity_tilt = {0.2, 0.2},
                  .floor_softness = {4, 4}},
                 robots, &randomizer, model.get());
  for (int geom = 0; geom < model->ngeom; ++geom) {
    EXPECT_EQ(model->geom_friction[3 * geom], 0.5 * plain->geom_friction[3 * geom]);
    EXPECT_EQ(model->geom_solref[mjNREF * geom], 2 * plain->geom_solref[mjNREF * geom]);
  }
  EXPECT_NEAR(model->opt.gravity[2], -10 * std::cos(0.2), 1e-9);
  const std::map<std::string, double> masses = Masses(*model);
  for (const robot::Drawn& one : randomizer.draws().values) {
    if (one.quantity == "mass") {
      EXPECT_EQ(masses.at(one.element), one.value);
    }
  }
  EXPECT_NE(masses.at("a/base"), 1);
  EXPECT_NE(masses.at("b/base"), 1);
  EXPECT_NE(masses.at("a/base"), masses.at("b/base"));
}

TEST_F(RandomizeModelTest, GivesEachBodyAMassOfItsOwnAndInertiaWithIt) {
  const ModelHandle model = Randomized({.mass = {0.5, 1.5}});
  EXPECT_THAT(drawn_, SizeIs(6));
  double sum = 0;
  for (const auto& [name, mass] : Masses(*model)) {
    EXPECT_EQ(mass, drawn_.at("mass/" + name));  // each weighs 1 kg
    EXPECT_GE(mass, 0.5);
    EXPECT_LE(mass, 1.5);
    EXPECT_EQ(model->body_inertia[3 * Body(name)], mass * plain_->body_inertia[3 * Body(name)]);
    sum += mass;
  }
  EXPECT_EQ(drawn_.at("mass/base") == drawn_.at("mass/head"), false);
  EXPECT_NEAR(physics::MujocoWorld(Randomized({.mass = {0.5, 1.5}}), {{spec_}}).robot().weight(),
              10 * sum, 1e-9);
}

TEST_F(RandomizeModelTest, GivesEachBodyAnInertiaOfItsOwnAndLeavesItsMass) {
  const ModelHandle model = Randomized({.inertia = {2, 3}});
  EXPECT_THAT(drawn_, SizeIs(6));
  for (const auto& [name, mass] : Masses(*model)) {
    EXPECT_EQ(mass, 1);
    for (int i = 0; i < 3; ++i) {
      const int at = 3 * Body(name) + i;
      EXPECT_EQ(model->body_inertia[at], drawn_.at("inertia/" + name) * plain_->body_inertia[at]);
    }
  }
}

// With 5 of 6 kg where they were, the centre of mass of all moves by a sixth of what the base's
// does.
TEST_F(RandomizeModelTest, MovesTheBasesCentreOfMassAndNothingThatIsFixedToTheBase) {
  physics::MujocoWorld before(Load(), {{spec_}});
  physics::MujocoWorld after(Randomized({.base_com = {0.02, 0.05}}), {{spec_}});
  const Eigen::Vector3d offset(drawn_.at("base_com/x"), drawn_.at("base_com/y"),
                               drawn_.at("base_com/z"));
  EXPECT_GE(offset.minCoeff(), 0.02);
  EXPECT_LE(offset.maxCoeff(), 0.05);
  for (physics::MujocoWorld* world : {&before, &after}) {
    world->robot().Reset(spec_.standing);
    world->BeginStep();
  }
  const int base = before.robot().Body("base");
  EXPECT_LT((after.CenterOfMass(base) - before.CenterOfMass(base) - offset).norm(), 1e-12);
  for (int geom = 0; geom < plain_->ngeom; ++geom) {
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(after.data().geom_xpos[3 * geom + i], before.data().geom_xpos[3 * geom + i],
                  1e-12);
    }
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(after.data().site_xpos[i], before.data().site_xpos[i], 1e-12);
    EXPECT_NEAR(after.data().subtree_com[3 * base + i],
                before.data().subtree_com[3 * base + i] + offset[i] / 6, 1e-12);
  }
}

TEST_F(RandomizeModelTest, ScalesTheDampingOfEachMotorsJoint) {
  const ModelHandle model = Randomized({.damping = {1.5, 2}});
  EXPECT_THAT(drawn_, SizeIs(6));
  for (const robot::MotorSpec* motor : robot::AllMotors(spec_)) {
    const double factor = drawn_.at("damping/" + motor->joint);
    EXPECT_EQ(model->dof_damping[Dof(motor->joint)], 0.1 * factor);
    EXPECT_GE(factor, 1.5);
    EXPECT_LE(factor, 2);
  }
  EXPECT_EQ(model->dof_damping[0], 0);  // the base floats as before
}

// The fixture has neither: a model that has is made of it first.
TEST_F(RandomizeModelTest, ScalesArmatureAndFrictionOfEachMotorsJoint) {
  robot::RobotSpec spec = test::FixtureRobot();
  spec.dynamics.use = robot::DynamicsSource::kFitted;
  spec.dynamics.fitted = {{.slots = {0, 1, 3, 4, 6, 7}, .armature = 0.5, .frictionloss = 2}};
  ModelHandle model =
      physics::LoadWorldModel({{spec, spec.model}}, test::FixtureFile("fixture_ground.xml"), 0.001);
  const double weight_before = model->dof_invweight0[Dof("FR_joint")];
  robot::Randomizer randomizer(1);
  RandomizeModel({.armature = {2, 3}, .frictionloss = {0, 0.5}}, std::span(&spec, 1), &randomizer,
                 model.get());
  std::map<std::string, double> drawn;
  for (const robot::Drawn& one : randomizer.draws().values)
    drawn[one.quantity + one.element] = one.value;
  EXPECT_THAT(drawn, SizeIs(12));
  for (const robot::MotorSpec& motor : spec.motors) {
    const int dof = Dof(motor.joint);
    EXPECT_EQ(model->dof_armature[dof], 0.5 * drawn.at("armature" + motor.joint));
    EXPECT_EQ(model->dof_frictionloss[dof], 2 * drawn.at("frictionloss" + motor.joint));
  }
  EXPECT_LT(model->dof_invweight0[Dof("FR_joint")], weight_before);  // derived anew
}

TEST_F(RandomizeModelTest, TurnsEachImuFromItsPlaceByTheRotationDrawn) {
  physics::MujocoWorld world(Randomized({.imu_mounting = {0.1, 0.2}}), {{spec_}});
  EXPECT_THAT(drawn_, SizeIs(6));
  world.robot().Reset(spec_.standing);
  const auto rotation = [this](const std::string& site) {
    const Eigen::Vector3d r(drawn_.at("imu_mounting/" + site + " x"),
                            drawn_.at("imu_mounting/" + site + " y"),
                            drawn_.at("imu_mounting/" + site + " z"));
    return Eigen::Quaterniond(Eigen::AngleAxisd(r.norm(), r.normalized()));
  };
  EXPECT_LT(world.robot().Imu().R_WI.angularDistance(rotation("imu")), 1e-9);
  const Eigen::Quaterniond upside_down(0, 1, 0, 0);
  EXPECT_LT(world.robot().SecondaryImu().R_WI.angularDistance(upside_down * rotation("head_imu")),
            1e-9);
  // The unit at rest feels the world's up where it is now.
  world.robot().Clamp(true);
  for (int i = 0; i < 500; ++i) {
    world.BeginStep();
    world.robot().Drive(std::vector<double>(6, 0.0));
    ASSERT_EQ(world.EndStep(), physics::StepHealth::kFine);
  }
  const Eigen::Vector3d up = rotation("imu").conjugate() * Eigen::Vector3d(0, 0, 10);
  EXPECT_LT((world.robot().Imu().f_WI_I - up).norm(), 0.5);
  EXPECT_GT((world.robot().Imu().f_WI_I - Eigen::Vector3d(0, 0, 10)).norm(), 1);
}

TEST_F(RandomizeModelTest, TiltsGravityByTheAngleDrawnToTheSideDrawn) {
  const ModelHandle model = Randomized({.gravity_tilt = {0.2, 0.3}});
  const double angle = drawn_.at("gravity_tilt/angle"), side = drawn_.at("gravity_tilt/side");
  EXPECT_GE(angle, 0.2);
  EXPECT_LE(angle, 0.3);
  const mjtNum* g = model->opt.gravity;
  EXPECT_NEAR(mju_norm3(g), 10, 1e-12);
  EXPECT_NEAR(g[2], -10 * std::cos(angle), 1e-9);
  EXPECT_NEAR(std::hypot(g[0], g[1]), 10 * std::sin(angle), 1e-9);
  EXPECT_NEAR(g[0] * std::cos(side) + g[1] * std::sin(side), 0, 1e-9);  // it turns about that axis
}

TEST_F(RandomizeModelTest, LetsContactsGiveWayAsFarAsDrawn) {
  const ModelHandle model = Randomized({.floor_softness = {4, 9}});
  const double factor = drawn_.at("floor_softness");
  for (int geom = 0; geom < model->ngeom; ++geom) {
    const mjtNum* was = plain_->geom_solref + mjNREF * geom;
    EXPECT_NEAR(model->geom_solref[mjNREF * geom], was[0] * std::sqrt(factor), 1e-12);
    EXPECT_EQ(model->geom_solref[mjNREF * geom + 1], was[1]);
  }
}

TEST_F(RandomizeModelTest, LetsARobotSinkDeeperIntoSoftGround) {
  const auto height = [this](const robot::RandomizationSpec& ranges) {
    physics::MujocoWorld world(Randomized(ranges), {{spec_}});
    world.robot().Reset(spec_.standing);
    for (int i = 0; i < 1000; ++i) {
      world.BeginStep();
      std::vector<double> tau;
      for (std::size_t m = 0; m < 6; ++m)
        tau.push_back(-200 * world.robot().q()[m] - 5 * world.robot().dq()[m]);
      world.robot().Drive(tau);
      EXPECT_EQ(world.EndStep(), physics::StepHealth::kFine);
    }
    return world.robot().base().p_WB.z();
  };
  EXPECT_LT(height({.floor_softness = {4, 4}}), height({}) - 1e-4);
}

}  // namespace
}  // namespace understudy::mjcf
