#include "mjcf/looks.h"

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "base/errors.h"
#include "mjcf/assets.h"
#include "mjcf/compile.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::mjcf {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr char kInertial[] = R"(<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>)";
constexpr char kSeen[] = R"(contype="0" conaffinity="0")";

class MjcfLooksTest : public test::MujocoTest {
 protected:
  // A body with these elements beside its freejoint, after those of the whole model.
  MjcfElement Read(const std::string& body, const std::string& rest = "") {
    return ReadMjcf(folder_.Write("robot.xml", "<mujoco>" + rest + "<worldbody><body><freejoint/>" +
                                                   body + "</body></worldbody></mujoco>"));
  }
  int GeomsLeftOut(const std::string& body, const std::string& rest = "") {
    MjcfElement root = Read(body, rest);
    return LeaveOutLooks(&root).geoms;
  }
  static std::string Geom(const std::string& attributes) {
    return "<geom size='.1' " + attributes + "/>";
  }

  test::TemporaryFolder folder_;
};

TEST_F(MjcfLooksTest, LeavesOutWhatTouchesNothingAndWeighsNothing) {
  EXPECT_EQ(GeomsLeftOut(kInertial + Geom(kSeen)), 1);
  EXPECT_EQ(GeomsLeftOut(Geom("mass='1'") + Geom(std::string("mass='0' ") + kSeen)), 1);
  EXPECT_EQ(GeomsLeftOut(Geom("mass='1'") + Geom(std::string("density='0' ") + kSeen)), 1);
}

TEST_F(MjcfLooksTest, KeepsWhatTouches) {
  EXPECT_EQ(GeomsLeftOut(kInertial + Geom("contype='0'") + Geom("conaffinity='0'") + Geom("")), 0);
}

TEST_F(MjcfLooksTest, KeepsWhatWeighs) {
  EXPECT_EQ(GeomsLeftOut(Geom("mass='1'") + Geom(kSeen)), 0);
  EXPECT_EQ(GeomsLeftOut(Geom("mass='1'") + Geom(std::string("mass='.1' density='0' ") + kSeen)),
            0);
  EXPECT_EQ(GeomsLeftOut(kInertial + Geom(kSeen), "<compiler inertiafromgeom='true'/>"), 0);
}

TEST_F(MjcfLooksTest, KeepsWhatAnythingNames) {
  const std::string pair = "<contact><pair geom1='a' geom2='b'/></contact>";
  EXPECT_EQ(GeomsLeftOut(kInertial + Geom(std::string("name='a' ") + kSeen), pair), 0);
  EXPECT_EQ(GeomsLeftOut(kInertial + Geom(std::string("name='c' ") + kSeen), pair), 1);
}

TEST_F(MjcfLooksTest, KeepsWhatSwims) {
  EXPECT_EQ(GeomsLeftOut(kInertial + Geom(std::string("fluidshape='ellipsoid' ") + kSeen)), 0);
}

TEST_F(MjcfLooksTest, CountsDefaultClassesIn) {
  const std::string defaults =
      "<default><default class='seen'><geom contype='0' conaffinity='0' density='0'/>"
      "<default class='felt'><geom contype='1'/></default></default></default>";
  EXPECT_EQ(GeomsLeftOut(Geom("mass='1'") + Geom("class='seen'"), defaults), 1);
  EXPECT_EQ(GeomsLeftOut(Geom("mass='1'") + Geom("class='felt'"), defaults), 0);
  EXPECT_EQ(GeomsLeftOut(Geom("class='felt'") + "<body childclass='seen'>" + Geom("") +
                             "<body childclass='felt'>" + Geom("") + "</body></body>",
                         defaults),
            1);
}

TEST_F(MjcfLooksTest, LeavesOutMeshesThatNoGeomHasAnyMore) {
  MjcfElement root =
      Read(kInertial + Geom(std::string("type='mesh' mesh='shell' ") + kSeen) +
               Geom("type='mesh' mesh='sole'"),
           "<asset><mesh name='shell' file='a.obj'/><mesh file='sole.obj'/></asset>");
  const LeftOutLooks left_out = LeaveOutLooks(&root);
  EXPECT_EQ(left_out.geoms, 1);
  EXPECT_EQ(left_out.meshes, 1);
  EXPECT_THAT(left_out.missing, ElementsAre(HasSubstr("a.obj")));
  EXPECT_EQ(root.children[0].children[0].Get("file"), (folder_.path() / "sole.obj").string());
}

TEST_F(MjcfLooksTest, LeavesOutTexturesAndTheirNames) {
  MjcfElement root = Read(Geom("material='m'"),
                          "<asset><texture name='t' type='2d' file='t.png'/>"
                          "<material name='m' texture='t' rgba='1 0 0 1'/></asset>");
  EXPECT_EQ(LeaveOutLooks(&root).textures, 1);
  EXPECT_EQ(CompileMjcf(root)->nmat, 1);
}

TEST_F(MjcfLooksTest, ChangesNoMassAndNoReading) {
  MjcfElement root = Read(kInertial + Geom("name='felt'") + Geom(kSeen) + "<site name='s'/>",
                          "<sensor><gyro site='s'/></sensor>");
  const ModelHandle before = CompileMjcf(root);
  LeaveOutLooks(&root);
  const ModelHandle after = CompileMjcf(root);
  EXPECT_EQ(after->ngeom, before->ngeom - 1);
  EXPECT_EQ(after->body_mass[1], before->body_mass[1]);
  EXPECT_EQ(after->nsensordata, before->nsensordata);
}

// Where the robot is after half a second of falling on a floor.
std::vector<double> Fallen(const MjcfElement& root) {
  const ModelHandle model = CompileMjcf(root);
  const DataHandle data(mj_makeData(model.get()));
  for (int i = 0; i < 500; ++i) mj_step(model.get(), data.get());
  return {data->qpos, data->qpos + model->nq};
}

TEST_F(MjcfLooksTest, ChangesNoBitOfTheMotion) {
  MjcfElement root = ReadMjcf(std::filesystem::path(UNDERSTUDY_SOURCE_DIR) / "models/go2/go2.xml");
  MjcfElement floor;
  floor.name = "worldbody";
  floor.children.push_back(
      {"geom",
       {{"type", "plane"}, {"size", "0 0 1"}, {"contype", "1"}, {"conaffinity", "1"}},
       {},
       {}});
  root.children.push_back(floor);
  const std::vector<double> before = Fallen(root);
  EXPECT_GT(LeaveOutLooks(&root).geoms, 10);
  EXPECT_EQ(Fallen(root), before);
}

TEST_F(MjcfLooksTest, NamesAFileThatIsOnlyAPointer) {
  folder_.Write("sole.obj", "version https://git-lfs.github.com/spec/v1\noid sha256:0\n");
  const MjcfElement root = Read(Geom("type='mesh' mesh='sole'"),
                                "<asset><mesh file='sole.obj'/>\n<mesh file='b.obj'/></asset>");
  try {
    RequireAssets(root);
    FAIL() << "nothing was refused";
  } catch (const ModelError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("robot.xml:1: "), HasSubstr("git lfs pull"),
                                             HasSubstr("1 more of its files")));
  }
}

}  // namespace
}  // namespace understudy::mjcf
