#include "physics/scene_reader.h"

#include <cstdint>
#include <cstring>

#include <mujoco/mujoco.h>

#include "gtest/gtest.h"
#include "physics/world_model.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::physics {
namespace {

constexpr char kModel[] = R"(<mujoco>
  <asset>
    <mesh name="wedge" vertex="0 0 0  1 0 0  0 1 0  0 0 1"/>
    <hfield name="hill" nrow="2" ncol="3" size="1 2 0.5 0.1"/>
    <material name="red" rgba="1 0 0 1"/>
  </asset>
  <worldbody>
    <camera name="eye" pos="1 2 3" fovy="60"/>
    <geom name="ground" type="hfield" hfield="hill"/>
    <body name="trunk" pos="0 0 1">
      <joint name="slider" type="slide" range="-0.5 0.5" limited="true"/>
      <geom name="box" type="box" size="0.1 0.2 0.3" pos="0 0 0.5" mass="2" material="red"/>
      <geom name="look" type="mesh" mesh="wedge" mass="1" contype="0" conaffinity="0" rgba="0 1 0 1"/>
    </body>
  </worldbody>
</mujoco>)";

class SceneReaderTest : public test::MujocoTest {
 protected:
  SceneReaderTest() { file_ = temp_.Write("model.xml", kModel); }

  template <class T>
  static T At(const std::string& bytes, std::size_t offset) {
    T value{};
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
  }

  test::TemporaryFolder temp_;
  std::filesystem::path file_;
  int made_ = 0;
  SceneReader dut_{[this] {
    ++made_;
    std::string why(300, '\0');
    return mjcf::ModelHandle(mj_loadXML(file_.c_str(), nullptr, why.data(), 300));
  }};
};

TEST_F(SceneReaderTest, MakesItsModelOnceAndOnlyWhenAsked) {
  EXPECT_EQ(made_, 0);
  dut_.Describe();
  dut_.Mesh(0);
  EXPECT_EQ(made_, 1);
}

TEST_F(SceneReaderTest, DescribesWhatIsThere) {
  const Scene scene = dut_.Describe();
  ASSERT_EQ(scene.bodies.size(), 2u);
  EXPECT_EQ(scene.bodies[1].name, "trunk");
  EXPECT_EQ(scene.bodies[1].mass, 3);
  ASSERT_EQ(scene.geoms.size(), 3u);
  EXPECT_EQ(scene.geoms[0].type, "hfield");
  EXPECT_EQ(scene.geoms[0].hfield, 0);
  EXPECT_EQ(scene.geoms[1].type, "box");
  EXPECT_EQ(scene.geoms[1].body, 1);
  EXPECT_EQ(scene.geoms[1].size[2], 0.3);
  EXPECT_EQ(scene.geoms[1].mesh, -1);
  EXPECT_EQ(scene.geoms[1].rgba, (std::array<float, 4>{1, 0, 0, 1}));
  EXPECT_TRUE(scene.geoms[1].collides);
  EXPECT_EQ(scene.geoms[2].mesh, 0);
  EXPECT_EQ(scene.geoms[2].rgba, (std::array<float, 4>{0, 1, 0, 1}));
  EXPECT_FALSE(scene.geoms[2].collides);
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_EQ(scene.cameras[0].fovy, 60);
  ASSERT_EQ(scene.joints.size(), 1u);
  EXPECT_TRUE(scene.joints[0].limited);
  EXPECT_EQ(scene.joints[0].range[1], 0.5);
}

TEST_F(SceneReaderTest, SendsAMeshInItsLayout) {
  const std::string bytes = dut_.Mesh(0);
  const auto vertices = At<std::uint32_t>(bytes, 0);
  const auto faces = At<std::uint32_t>(bytes, 4);
  EXPECT_EQ(vertices, 4u);
  EXPECT_EQ(faces, 4u);
  ASSERT_EQ(bytes.size(), 8 + 12 * (vertices + faces));
  for (std::size_t i = 0; i < 3 * faces; ++i) {
    EXPECT_LT(At<std::uint32_t>(bytes, 8 + 12 * vertices + 4 * i), vertices);
  }
}

TEST_F(SceneReaderTest, SendsAHeightFieldInItsLayout) {
  const std::string bytes = dut_.HeightField(0);
  EXPECT_EQ(At<std::uint32_t>(bytes, 0), 2u);
  EXPECT_EQ(At<std::uint32_t>(bytes, 4), 3u);
  EXPECT_EQ(bytes.size(), 8u + 4 * 6);
}

TEST_F(SceneReaderTest, SendsAModelThatLoadsAgain) {
  const std::string file = temp_.Write("model.mjb", dut_.Model());
  const mjcf::ModelHandle model(mj_loadModel(file.c_str(), nullptr));
  ASSERT_NE(model, nullptr);
  EXPECT_EQ(model->nbody, 2);
  EXPECT_EQ(model->nmesh, 1);
}

}  // namespace
}  // namespace understudy::physics
