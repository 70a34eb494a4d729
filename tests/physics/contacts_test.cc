#include "physics/contacts.h"

#include <string>

#include <gtest/gtest.h>

#include "physics/world_model.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::physics {
namespace {

class ContactsTest : public test::MujocoTest {};

TEST_F(ContactsTest, PyramidsTakeThePlaceOfConesAndOfRollingFriction) {
  const std::string text = R"(
    <mujoco>
      <option cone="elliptic" impratio="100"/>
      <worldbody>
        <geom name="floor" type="plane" size="1 1 1" condim="1"/>
        <body><freejoint/><geom name="foot" size="0.02" condim="6"/></body>
      </worldbody>
      <contact><pair geom1="floor" geom2="foot" condim="4"/></contact>
    </mujoco>)";
  const test::TemporaryFolder folder;
  const mjcf::ModelHandle model = LoadModelFile(folder.Write("foot.xml", text));
  UsePyramids(model.get());
  EXPECT_EQ(model->opt.cone, mjCONE_PYRAMIDAL);
  EXPECT_EQ(model->opt.impratio, 1);
  EXPECT_EQ(model->geom_condim[0], 1) << "what has no friction gets none";
  EXPECT_EQ(model->geom_condim[1], 3);
  EXPECT_EQ(model->pair_dim[0], 3);
}

}  // namespace
}  // namespace understudy::physics
