#include <filesystem>
#include <vector>

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include "mjcf/compile.h"
#include "mjcf/document.h"
#include "mjcf/mujoco_handles.h"

namespace understudy::mjcf {
namespace {

// Where the bodies are and the inertia of what hangs from each, at other angles than 0.
std::vector<double> Kinematics(const mjModel& model, mjData* data) {
  for (int i = 7; i < model.nq; ++i) data->qpos[i] = 0.01 * i;
  mj_kinematics(&model, data);
  mj_comPos(&model, data);
  mj_crb(&model, data);
  std::vector<double> values(data->xpos, data->xpos + 3L * model.nbody);
  values.insert(values.end(), data->crb, data->crb + 10L * model.nbody);
  return values;
}

TEST(DataWithoutContactsTest, HasTheSameKinematicsInLessMemory) {
  const ModelHandle model = CompileMjcf(
      ReadMjcf(std::filesystem::path(UNDERSTUDY_SOURCE_DIR) / "models/g1/g1_29dof.xml"));
  const DataHandle whole(mj_makeData(model.get()));
  const DataHandle small = MakeDataWithoutContacts(*model);
  EXPECT_EQ(Kinematics(*model, small.get()), Kinematics(*model, whole.get()));
  EXPECT_LE(small->nbuffer, whole->nbuffer);
#if mjVERSION_HEADER < 300  // later ones make room for contacts when there are any
  EXPECT_LT(small->nbuffer, whole->nbuffer / 10);
#endif
}

}  // namespace
}  // namespace understudy::mjcf
