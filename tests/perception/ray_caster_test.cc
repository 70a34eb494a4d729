#include "perception/ray_caster.h"

#include <cmath>

#include <gmock/gmock.h>

#include "tests/perception/random_scene.h"
#include "tests/support/allocations.h"
#include "tests/support/mujoco_test.h"

namespace understudy::perception {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class RayCasterTest : public test::MujocoTest {};

// Returns how many of `count` rays hit something.
int Compare(const RayCaster& scene, test::RandomScene* random, int count) {
  int hits = 0;
  for (int i = 0; i < count; ++i) {
    const Ray ray = random->Ray();
    const Hit slow = random->Slowly(ray), fast = scene.Cast(ray);
    EXPECT_EQ(std::isfinite(slow.distance), std::isfinite(fast.distance)) << i;
    if (!std::isfinite(slow.distance)) continue;
    ++hits;
    EXPECT_NEAR(fast.distance, slow.distance, 1e-9) << i;
  }
  return hits;
}

TEST_F(RayCasterTest, IsMetWhereMujocoSaysByAnyRay) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(seed);
    test::RandomScene random(seed);
    RayCaster scene(*random.model, *random.data);
    EXPECT_GT(Compare(scene, &random, 3000), 1500);
    for (int i = 0; i < 3; ++i) {
      random.Move();
      scene.Follow(i, *random.data);
      EXPECT_GT(Compare(scene, &random, 1000), 500);
    }
  }
}

TEST_F(RayCasterTest, NamesTheGeomThatIsMet) {
  test::RandomScene random(3);
  const RayCaster scene(*random.model, *random.data);
  for (int i = 0; i < 1000; ++i) {
    const Ray ray = random.Ray();
    EXPECT_EQ(scene.Cast(ray).geom, random.Slowly(ray).geom) << i;
  }
}

TEST_F(RayCasterTest, IsMetBehindWhatIsLeftOut) {
  test::RandomScene random(4);
  const RayCaster scene(*random.model, *random.data);
  int further = 0;
  for (int i = 0; i < 500; ++i) {
    const Ray ray = random.Ray();
    const Hit first = scene.Cast(ray);
    if (first.geom < 0) continue;
    const int without[] = {first.geom};
    const Hit second = scene.Cast(ray, without);
    EXPECT_NE(second.geom, first.geom);
    EXPECT_GE(second.distance, first.distance);
    further += second.geom >= 0 ? 1 : 0;
  }
  EXPECT_GT(further, 50);
}

TEST_F(RayCasterTest, KnowsInWhichGeomsAPointLies) {
  const test::TemporaryFolder folder;
  const mjcf::ModelHandle model =
      physics::LoadModelFile(folder.Write("scene.xml", R"(<mujoco><worldbody>
        <geom type="box" size="1 1 1"/><geom type="sphere" size="0.5" pos="0.9 0 0"/>
        <geom type="box" size="1 1 1" contype="0" conaffinity="0"/></worldbody></mujoco>)"));
  const mjcf::DataHandle data(mj_makeData(model.get()));
  mj_kinematics(model.get(), data.get());
  const RayCaster scene(*model, *data);
  EXPECT_THAT(scene.Around({0, 0, 0}), ElementsAre(0));
  EXPECT_THAT(scene.Around({0.9, 0, 0}), ElementsAre(0, 1));
  EXPECT_THAT(scene.Around({1.3, 0, 0}), ElementsAre(1));
  EXPECT_THAT(scene.Around({3, 0, 0}), IsEmpty());
}

TEST_F(RayCasterTest, FollowsAStepOnce) {
  test::RandomScene random(3);
  RayCaster scene(*random.model, *random.data);
  std::vector<Ray> rays;
  for (int i = 0; i < 300; ++i) rays.push_back(random.Ray());
  const auto distances = [&] {
    std::vector<double> of_rays;
    for (const Ray& ray : rays) of_rays.push_back(scene.Cast(ray).distance);
    return of_rays;
  };
  scene.Follow(5, *random.data);
  const auto before = distances();
  random.Move();
  scene.Follow(5, *random.data);
  EXPECT_EQ(distances(), before) << "a second robot that looks in the same step";
  scene.Follow(6, *random.data);
  EXPECT_NE(distances(), before);
}

TEST_F(RayCasterTest, AllocatesNothingByRayOrInstant) {
  test::RandomScene random(5);
  RayCaster scene(*random.model, *random.data);
  const std::uint64_t before = test::Allocations();
  int hits = 0;
  for (int i = 0; i < 1000; ++i) {
    random.Move();
    scene.Follow(i, *random.data);
    hits += scene.Cast(random.Ray()).geom >= 0 ? 1 : 0;
  }
  EXPECT_EQ(test::Allocations(), before);
  EXPECT_GT(hits, 500);
}

TEST_F(RayCasterTest, HasNoGeomThatNothingTouches) {
  const test::TemporaryFolder folder;
  const mjcf::ModelHandle model =
      physics::LoadModelFile(folder.Write("scene.xml", R"(<mujoco><worldbody>
        <geom type="sphere" size="1" contype="0" conaffinity="0"/></worldbody></mujoco>)"));
  const mjcf::DataHandle data(mj_makeData(model.get()));
  mj_kinematics(model.get(), data.get());
  EXPECT_EQ(RayCaster(*model, *data).Cast({{-3, 0, 0}, {1, 0, 0}}).geom, -1);
}

TEST_F(RayCasterTest, IsMetWhereAScanIsInPlaceOfTheGroundThatStandsForIt) {
  constexpr char kScene[] = R"(<mujoco><worldbody>
    <geom name="ground_0" type="box" size="5 5 1" pos="0 0 -0.5"/>
    <geom name="pole" type="box" size="0.1 0.1 2" pos="3 0 0"/></worldbody></mujoco>)";
  const test::TemporaryFolder folder;
  const mjcf::ModelHandle model = physics::LoadModelFile(folder.Write("scene.xml", kScene));
  const mjcf::DataHandle data(mj_makeData(model.get()));
  mj_kinematics(model.get(), data.get());
  const std::vector<mjcf::MeshPart> scan{{std::nullopt, {-5, -5, 0, 5, -5, 0, 0, 5, 0}},
                                         {std::nullopt, {2, -1, 0, 2, 1, 0, 2, 0, 1}}};
  RayCaster rays(*model, *data, &scan);
  const Hit floor = rays.Cast({{0, 0, 2}, {0, 0, -1}}), wall = rays.Cast({{0, 0, 0.3}, {1, 0, 0}});
  EXPECT_NEAR(floor.distance, 2, 1e-6);
  EXPECT_EQ(floor.geom, 0);
  EXPECT_NEAR(wall.distance, 2, 1e-6);
  // What else stands there is met as well, over the wall.
  EXPECT_NEAR(rays.Cast({{0, 0, 1.5}, {1, 0, 0}}).distance, 2.9, 1e-6);
  rays.Follow(1, *data);
  EXPECT_NEAR(rays.Cast({{0, 0, 0.3}, {1, 0, 0}}).distance, 2, 1e-6);
}

}  // namespace
}  // namespace understudy::perception
