#include "mjcf/saved_model.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "config/data_dir.h"
#include "config/load.h"
#include "config/model_files.h"
#include "config/robot_file.h"
#include "mjcf/compile.h"
#include "mjcf/document.h"
#include "physics/world_model.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::mjcf {
namespace {

class SavedModelTest : public test::MujocoTest {
 protected:
  static ModelHandle World(const std::string& robot, const std::filesystem::path& scene) {
    const robot::RobotSpec spec =
        config::LoadConfig({.robot = robot}, config::DataDir()).robots[0].spec;
    return physics::LoadWorldModel(
        {{.spec = spec, .file = config::ModelFile(spec), .hands = config::HandModelFiles(spec)}},
        scene, 0.001);
  }
  ModelHandle Read(const SavedModel& saved) {
    for (const SavedField& field : saved.fields) folder_.Write(field.file, field.bytes);
    return CompileMjcf(ReadMjcf(folder_.Write("saved.xml", saved.xml)));
  }

  test::TemporaryFolder folder_;
};

void ExpectNear(const mjtNum* one, const mjtNum* other, std::int64_t count, const char* what) {
  for (std::int64_t i = 0; i < count; ++i) {
    EXPECT_NEAR(one[i], other[i], 1e-5 * std::max(1.0, std::abs(one[i]))) << what << " " << i;
  }
}

TEST_F(SavedModelTest, HasTheFiguresOfEveryRobotsModel) {
  for (const std::string& robot : config::RobotNames(config::DataDir())) {
    SCOPED_TRACE(robot);
    const ModelHandle own = World(robot, config::SceneFile("flat", {}).path());
    const ModelHandle read = Read(SaveModel(*own, physics::kClampName));
    ASSERT_EQ(read->nbody, own->nbody);
    ASSERT_EQ(read->nv, own->nv);
    ASSERT_EQ(read->ngeom, own->ngeom);
    ExpectNear(own->body_mass, read->body_mass, own->nbody, "mass");
    ExpectNear(own->body_inertia, read->body_inertia, 3 * own->nbody, "inertia");
    ExpectNear(own->dof_armature, read->dof_armature, own->nv, "armature");
    ExpectNear(own->dof_damping, read->dof_damping, own->nv, "damping");
    ExpectNear(own->dof_frictionloss, read->dof_frictionloss, own->nv, "frictionloss");
    ExpectNear(own->jnt_range, read->jnt_range, 2 * own->njnt, "range");
    ExpectNear(own->geom_friction, read->geom_friction, 3 * own->ngeom, "friction");
    EXPECT_EQ(own->opt.timestep, read->opt.timestep);
  }
}

TEST_F(SavedModelTest, LeavesOutTheClampAndHasActuatorsThatWork) {
  const ModelHandle own = World("go2", config::SceneFile("flat", {}).path());
  const ModelHandle read = Read(SaveModel(*own, physics::kClampName));
  EXPECT_EQ(read->neq, own->neq - 1);
  EXPECT_EQ(read->nu, own->nu);
  EXPECT_EQ(read->opt.disableflags & (mjDSBL_ACTUATION | mjDSBL_SENSOR), 0);
}

TEST_F(SavedModelTest, BringsHeightsOfTheGround) {
  const ModelHandle own = World("go2", config::SceneFile("rough", {}).path());
  const SavedModel saved = SaveModel(*own, physics::kClampName);
  ASSERT_FALSE(saved.fields.empty());
  const ModelHandle read = Read(saved);
  ASSERT_EQ(read->nhfielddata, own->nhfielddata);
  for (int i = 0; i < static_cast<int>(own->nhfielddata); ++i) {
    ASSERT_NEAR(own->hfield_data[i], read->hfield_data[i], 1e-6) << i;
  }
  ExpectNear(own->hfield_size, read->hfield_size, 4 * own->nhfield, "size");
}

}  // namespace
}  // namespace understudy::mjcf
