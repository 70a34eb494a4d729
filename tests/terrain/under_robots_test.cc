// Every kind of ground under a quadruped and a humanoid.
#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <vector>

#include <mujoco/mujoco.h>

#include "config/load.h"
#include "physics/mujoco_world.h"
#include "tests/terrain/fixture.h"

namespace understudy::terrain {
namespace {

struct Ground {
  std::string robot, kind;
};

class TerrainOfKindTest : public TerrainTest, public testing::WithParamInterface<Ground> {
 protected:
  TerrainOfKindTest() {
    if (GetParam().kind == "image") UseImage();
  }

  physics::MujocoWorld World() {
    const robot::RobotSpec& spec = config_.robots[0].spec;
    return {physics::LoadWorldModel({{spec, data_dir_ / "models" / spec.model}},
                                    Write(GetParam().kind) / "scene.xml", 0.001),
            {{spec}}};
  }

  // How far [m] the robot is out of the ground, negative for inside, when it is `lowered` [m] by
  // that from where it is; 1 where nothing touches.
  static double Clearance(const physics::MujocoWorld& world, double lowered) {
    const mjModel& model = world.model();
    const mjcf::DataHandle data(mj_copyData(nullptr, &model, &world.data()));
    data->qpos[2] -= lowered;
    mj_forward(&model, data.get());
    double least = 1;
    for (int i = 0; i < data->ncon; ++i) {
      const mjContact& contact = data->contact[i];
      const int body1 = model.geom_bodyid[contact.geom1];
      const int body2 = model.geom_bodyid[contact.geom2];
      if (model.body_weldid[body1] != 0 && model.body_weldid[body2] != 0) continue;
      least = std::min(least, contact.dist);
    }
    return least;
  }

  // How far [m] it has to fall at most until it touches: g1.yaml has it lie 56 mm over the ground.
  double Drop(const robot::PoseSpec& pose) const {
    return GetParam().robot == "g1" && &pose == &config_.robots[0].spec.lying ? 0.06 : 0.02;
  }

  const std::filesystem::path data_dir_ = UNDERSTUDY_SOURCE_DIR;
  config::Config config_ =
      config::LoadConfig({.robot = GetParam().robot, .files = {}, .sets = {}}, data_dir_);
};

TEST_P(TerrainOfKindTest, CarriesTheRobotWithoutAWarning) {
  spec_.difficulty = 1;
  physics::MujocoWorld world = World();
  world.robot().Reset(config_.robots[0].spec.lying);
  const std::vector<double> tau(world.robot().q().size());
  for (int i = 0; i < 200; ++i) {
    world.BeginStep();
    world.robot().Drive(tau);
    ASSERT_EQ(world.EndStep(), physics::StepHealth::kFine);
  }
  EXPECT_GT(world.data().ncon, 0);
}

TEST_P(TerrainOfKindTest, HasTheRobotOnThePlatformAtTheStart) {
  physics::MujocoWorld world = World();
  for (const robot::PoseSpec* pose :
       {&config_.robots[0].spec.standing, &config_.robots[0].spec.lying}) {
    world.robot().Reset(*pose);
    EXPECT_EQ(world.robot().base().p_WB.z(), pose->height);
    EXPECT_GT(Clearance(world, 0), -0.01);
    EXPECT_LT(Clearance(world, Drop(*pose)), 0);
  }
}

TEST_P(TerrainOfKindTest, HasTheRobotOnTheGroundWhereverItStarts) {
  spec_.difficulty = 0.7;
  for (const double start : {3.0, 5.5, 7.3}) {  // m along the patch; the ground is moved, not it
    mjcf::ModelHandle model = physics::LoadWorldModel(
        {{config_.robots[0].spec, data_dir_ / "models" / config_.robots[0].spec.model}},
        Write(GetParam().kind) / "scene.xml", 0.001);
    for (int body = 1; body < model->nbody; ++body) {
      if (model->body_weldid[body] == 0) model->body_pos[3 * body] -= start;
    }
    physics::MujocoWorld world(std::move(model), {{config_.robots[0].spec}});
    for (const robot::PoseSpec* pose :
         {&config_.robots[0].spec.standing, &config_.robots[0].spec.lying}) {
      world.robot().Reset(*pose);
      EXPECT_GT(Clearance(world, 0), -0.01) << "at " << start;
      EXPECT_LT(Clearance(world, Drop(*pose)), 0) << "at " << start;
    }
  }
}

TEST_P(TerrainOfKindTest, RubsAsMuchAsAsked) {
  spec_.friction = 0.3;  // less than any robot's own
  physics::MujocoWorld world = World();
  world.robot().Reset(config_.robots[0].spec.standing);
  const std::vector<double> tau(world.robot().q().size());
  int touching = 0;
  for (int i = 0; i < 300; ++i) {
    world.BeginStep();
    for (int c = 0; c < world.data().ncon; ++c) {
      const mjContact& contact = world.data().contact[c];
      const int body1 = world.model().geom_bodyid[contact.geom1];
      const int body2 = world.model().geom_bodyid[contact.geom2];
      if (world.model().body_weldid[body1] != 0 && world.model().body_weldid[body2] != 0) continue;
      ++touching;
      ASSERT_EQ(contact.friction[0], 0.3);
    }
    world.robot().Drive(tau);
    ASSERT_EQ(world.EndStep(), physics::StepHealth::kFine);
  }
  EXPECT_GT(touching, 0);
}

TEST_P(TerrainOfKindTest, RubsAsMuchAsIsSetLaterUntilThatIsTakenBack) {
  spec_.difficulty = 0.7;
  physics::MujocoWorld world = World();
  const mjModel& model = world.model();
  const std::vector<mjtNum> before(model.geom_friction, model.geom_friction + 3 * model.ngeom);
  world.SetGroundFriction(0.3);
  for (int geom = 0; geom < model.ngeom; ++geom) {
    const bool moves = model.body_weldid[model.geom_bodyid[geom]] != 0;
    EXPECT_EQ(model.geom_friction[3 * geom],
              moves ? before[static_cast<std::size_t>(3 * geom)] : 0.3)
        << geom;
  }
  EXPECT_EQ(world.GroundFriction(), (std::array{0.3, 0.3}));
  world.SetGroundFriction(0);
  EXPECT_TRUE(std::ranges::equal(before, std::span(model.geom_friction, before.size())));
}

TEST_P(TerrainOfKindTest, IsTheSameWorldWhenReadFromWhatWasWritten) {
  const auto save = [&](const std::filesystem::path& folder) {
    const mjcf::ModelHandle model = physics::LoadWorldModel(
        {{config_.robots[0].spec, data_dir_ / "models" / config_.robots[0].spec.model}},
        folder / "scene.xml", 0.001);
    std::string bytes(static_cast<std::size_t>(mj_sizeModel(model.get())), '\0');
    mj_saveModel(model.get(), nullptr, bytes.data(), static_cast<int>(bytes.size()));
    return bytes;
  };
  const std::filesystem::path here = Write(GetParam().kind, "here");
  const std::filesystem::path there = folder_.path() / "there";
  std::filesystem::copy(here, there, std::filesystem::copy_options::recursive);
  const std::string bytes = save(here);
  std::filesystem::remove_all(here);
  std::filesystem::rename(there, here);  // MuJoCo 3 keeps the names of files in the model
  EXPECT_TRUE(bytes == save(here));
}

std::vector<Ground> Grounds() {
  std::vector<Ground> grounds;
  for (const char* robot : {"go2", "g1"}) {
    for (const std::string& kind : TerrainKinds()) grounds.push_back({robot, kind});
  }
  return grounds;
}

INSTANTIATE_TEST_SUITE_P(Robots, TerrainOfKindTest, testing::ValuesIn(Grounds()),
                         [](const auto& test) { return test.param.robot + "_" + test.param.kind; });

}  // namespace
}  // namespace understudy::terrain
