#include "terrain/scan.h"

#include <cmath>

#include <mujoco/mujoco.h>

#include "tests/support/error_of.h"
#include "tests/support/temporary_folder.h"
#include "tests/terrain/fixture.h"

namespace understudy::terrain {
namespace {

using testing::HasSubstr;

// A floor of 4 by 4 m with a hole, a table of 0.7 m, a wall at x = 2 and a ceiling; y is up.
constexpr char kRoom[] = R"(
v -2 0 -2
v 2 0 -2
v 2 0 0.5
v -2 0 0.5
f 4 3 2 1
v -2 0 1
v 2 0 1
v 2 0 2
v -2 0 2
f 8 7 6 5
v 0.5 0.7 -1
v 1.5 0.7 -1
v 1.5 0.7 0
v 0.5 0.7 0
f 12 11 10 9
v 2 2.5 -2
v 2 2.5 2
f 2 7 14 13
v -2 2.5 -2
v -2 2.5 2
f 13 14 16 15
)";

class ScanTest : public TerrainTest {
 protected:
  ScanTest() { spec_.scan.quat = {std::sqrt(0.5), std::sqrt(0.5), 0, 0}; }

  Scan Read(const std::string& text = kRoom) {
    return ReadScan(files_.Write("room.obj", text), spec_.scan);
  }
  void LoadScan(const std::string& text = kRoom) {
    WriteScan(Read(text), spec_, folder_.path() / "scan");
    LoadFile(folder_.path() / "scan" / "scene.xml");
  }
  std::string Fault(const std::string& text = kRoom) {
    return test::ErrorOf<ModelError>([&] { LoadScan(text); });
  }
  test::TemporaryFolder files_;
};

TEST_F(ScanTest, IsTouchedAsTheHighestSurfaceUpToItsHeight) {
  LoadScan();
  EXPECT_NEAR(Height(-1, 1), 0, 1e-3);
  EXPECT_NEAR(Height(1, 0.5), 0.7, 1e-3);     // the table, down to the floor
  EXPECT_NEAR(Height(1.999, -1.5), 1, 0.03);  // the wall, as far as it is touched
  EXPECT_NEAR(Height(1.9, -1.5), 0, 1e-3);    // one cell before it
  EXPECT_NEAR(Height(0, -0.75), 0, 1e-3);     // where nothing was scanned
  EXPECT_NEAR(Height(-5, 0), -0.05, 1e-3);    // round about
}

TEST_F(ScanTest, PassesBelowWhatIsHigherThanItsHeight) {
  spec_.scan.height = 0.5;
  LoadScan();
  EXPECT_NEAR(Height(1, 0.5), 0, 1e-3);
}

TEST_F(ScanTest, RisesToAWallOverACell) {
  spec_.scan.cell = 0.5;
  LoadScan();
  EXPECT_NEAR(Height(1.8, -1.5), 0.6, 0.05);
}

TEST_F(ScanTest, StandsWhereItsPoseSays) {
  spec_.scan.scale = 0.5;
  spec_.scan.pos = {10, 0, 0.2};
  LoadScan();
  EXPECT_NEAR(Height(9.5, 0.5), 0.2, 1e-3);
  EXPECT_NEAR(Height(10.5, 0.25), 0.55, 1e-3);
}

TEST_F(ScanTest, MayBeFlat) {
  LoadScan("v 0 0 0\nv 3 0 0\nv 3 0 -3\nv 0 0 -3\nf 1 2 3 4\n");
  EXPECT_NEAR(Height(1, 1), 0, 1e-3);
  EXPECT_GE(mj_name2id(model_.get(), mjOBJ_GEOM, mjcf::kScanGround), 0);
  LoadFile(folder_.path() / "scan" / "sight.xml");
  EXPECT_EQ(model_->nmeshface, 2);
}

TEST_F(ScanTest, IsSeenAsItIsAndNotTouched) {
  LoadScan();
  LoadFile(folder_.path() / "scan" / "sight.xml");
  const int mesh = mj_name2id(model_.get(), mjOBJ_GEOM, "scan_0");
  ASSERT_GE(mesh, 0);
  EXPECT_EQ(model_->geom_contype[mesh], 0);
  EXPECT_EQ(mj_name2id(model_.get(), mjOBJ_GEOM, mjcf::kScanGround), -1);
  EXPECT_EQ(model_->nmeshface, 10);
}

TEST_F(ScanTest, SaysWhatItsKeysShouldBe) {
  spec_.scan.scale = 1000;
  EXPECT_THAT(Fault(), HasSubstr("4000 m large; expected at most 200 m. terrain.scan.scale"));
  spec_.scan.scale = 1;
  spec_.scan.pos = {0, 0, 5};
  EXPECT_THAT(Fault(), HasSubstr("begins at z = 5 m, above terrain.scan.height, 1 m"));
  spec_.scan.pos = {0, 0, 0};
  spec_.scan.cell = 0.01;
  std::string slivers;
  for (int i = 0; i < 2000; ++i) slivers += "v 0 0 0\nv 190 0 0\nv 0 0 190\nf -3 -2 -1\n";
  EXPECT_THAT(Fault(slivers), HasSubstr("terrain.scan.cell: its surfaces would be sampled"));
  spec_.scan.quat = {0, 0, 0, 0};
  EXPECT_THAT(Fault(), HasSubstr("terrain.scan.quat"));
}

}  // namespace
}  // namespace understudy::terrain
