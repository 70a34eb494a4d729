#include "server/scene_files.h"

#include <mujoco/mujoco.h>
#include <nlohmann/json.hpp>

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/support/temporary_folder.h"

namespace understudy::server {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

constexpr char kModel[] = R"(<mujoco>
  <compiler angle="radian"/>
  <asset><mesh name="wedge" vertex="0 0 0  1 0 0  0 1 0  0 0 1"/></asset>
  <worldbody>
    <body name="trunk">
      <joint name="knee" range="-1 2" limited="true"/>
      <joint name="wheel"/>
      <geom type="mesh" mesh="wedge" mass="1"/>
    </body>
  </worldbody>
</mujoco>)";

class SceneFilesTest : public ::testing::Test {
 protected:
  SceneFilesTest() {
    robot_.name = "two_joints";
    robot_.base_body = "trunk";
    robot_.hands = {{.name = "left", .motors = {{.joint = "thumb", .slot = 9}, {.joint = "knee"}}}};
    robot_.motors = {{.joint = "knee", .slot = 3, .torque_limit = 23.5}, {.joint = "wheel"}};
    robot_.imu.site = "imu";
    robot_.motion.humanoid.lock_stand = 4;
    robot_.motion.humanoid.unplayed = {702};
    robot_.remote.chords = {{.keys = "L2+B", .does = "damp"},
                            {.keys = "START", .clicks = 2, .does = "trot_run", .from = {3}},
                            {.keys = "L2+UP", .does = "set_fsm", .value = 4},
                            {.keys = "L2+X", .does = "set_fsm", .value = 702},
                            {.keys = "SELECT+A", .does = "arm_action", .value = 27}};
    robot_.hands[0].pads = {{.site = "left_tip_touch", .rows = 2, .columns = 3},
                            {.rows = 1, .columns = 2, .taxels = {1}}};
    robot_.feet = {{.name = "FR", .geoms = {}}};
  }

  test::TemporaryFolder temp_;
  std::string file_ = temp_.Write("model.xml", kModel).string();
  physics::SceneReader reader_{[this] {
    std::string why(300, '\0');
    return mjcf::ModelHandle(mj_loadXML(file_.c_str(), nullptr, why.data(), 300));
  }};
  robot::RobotSpec robot_;
  SceneFiles dut_{&reader_, &robot_};
};

TEST_F(SceneFilesTest, NamesWhatSnapshotsHaveByNumber) {
  const json scene = json::parse(dut_.Scene().content());
  EXPECT_EQ(scene["robot"], "two_joints");
  EXPECT_EQ(scene["base"], 1);
  EXPECT_EQ(scene["bodies"][1]["name"], "trunk");
  EXPECT_EQ(scene["motors"][0]["name"], "knee");
  EXPECT_EQ(scene["motors"][0]["slot"], 3);
  EXPECT_EQ(scene["motors"][0]["range"], json({-1.0, 2.0}));
  EXPECT_EQ(scene["motors"][0]["torque_limit"], 23.5);
  EXPECT_EQ(scene["motors"][1]["range"], nullptr);
  EXPECT_EQ(scene["motors"][1]["qpos"], 1);
  ASSERT_EQ(scene["motors"].size(), 4u);
  EXPECT_FALSE(scene["motors"][1].contains("hand"));
  EXPECT_EQ(scene["motors"][2]["name"], "thumb");
  EXPECT_EQ(scene["motors"][3]["hand"], "left");
  EXPECT_EQ(scene["motors"][3]["slot"], 1);
  EXPECT_EQ(scene["imus"], json({"imu"}));
  EXPECT_EQ(scene["feet"], json({"FR"}));
  EXPECT_EQ(scene["pads"], json::parse(R"([
      {"hand": "left", "name": "left_tip", "rows": 2, "columns": 3, "taxels": []},
      {"hand": "left", "name": "", "rows": 1, "columns": 2, "taxels": [1]}])"));
  EXPECT_EQ(scene["poses"], json({"lying", "standing", "hanging", "clamped"}));
}

TEST_F(SceneFilesTest, NamesWhatChordsDo) {
  const json chords = json::parse(dut_.Scene().content())["chords"];
  std::vector<std::string> names;
  for (const json& chord : chords) names.push_back(chord["name"]);
  EXPECT_EQ(names, (std::vector<std::string>{"damp", "trot run", "ready", "stand up from lying",
                                             "shake hand"}));
  EXPECT_EQ(chords[1]["keys"], "START");
  EXPECT_EQ(chords[1]["clicks"], 2);
  EXPECT_EQ(chords[1]["from"], json({3}));
}

TEST_F(SceneFilesTest, SaysOfAHumanoidsChordsWhereTheyAreTakenAndWhatIsNotSimulated) {
  robot_.kind = robot::RobotKind::kHumanoid;
  robot_.remote.chords[2].from = {1, 2};
  const json scene = json::parse(dut_.Scene().content());
  const json& chords = scene["chords"];
  EXPECT_EQ(chords[0]["effects"], json::parse(R"([{"from": 0, "to": 1}, {"from": 1, "to": 1},
                                                  {"from": 4, "to": 1}])"));
  EXPECT_EQ(chords[2]["effects"], json::parse(R"([{"from": 1, "to": 4}])"));
  EXPECT_EQ(chords[2]["simulated"], true);
  EXPECT_EQ(chords[3]["simulated"], false);
  EXPECT_EQ(chords[3]["effects"], json::array());
  EXPECT_EQ(scene["states"],
            json::parse(R"([{"id": 0, "name": "zero torque"}, {"id": 1, "name": "damping"},
                            {"id": 4, "name": "ready"}])"));
}

TEST_F(SceneFilesTest, SaysOfAQuadrupedsChordsFromWhereToWhereTheyLead) {
  robot_.kind = robot::RobotKind::kQuadruped;
  robot_.motion.quadruped.gestures_from_lock = true;
  robot_.remote.chords = {{.keys = "L2+A", .does = "stand_up"},
                          {.keys = "START", .does = "balance_stand"},
                          {.keys = "R1+B", .does = "sit"}};
  const json scene = json::parse(dut_.Scene().content());
  const auto leads = [&](std::size_t chord, int from) {
    for (const json& effect : scene["chords"][chord]["effects"]) {
      if (effect["from"] == from) return effect["to"].get<int>();
    }
    return -1;
  };
  EXPECT_EQ(leads(0, 1001), 1002);  // damping: stands, joints locked
  EXPECT_EQ(leads(1, 1001), -1);
  EXPECT_EQ(leads(1, 1002), 1013);
  EXPECT_EQ(leads(2, 1001), -1);
  EXPECT_EQ(leads(2, 1002), 1007);  // by way of a balanced stand
  EXPECT_EQ(leads(2, 100), 1007);
  int names = 0;
  for (const json& state : scene["states"]) names += state["id"] == 1002 ? 1 : 0;
  EXPECT_EQ(names, 1);
}

TEST_F(SceneFilesTest, SendsMeshesByTheirNumber) {
  const HttpReply mesh = dut_.Mesh("0");
  EXPECT_EQ(mesh.status, 200u);
  EXPECT_EQ(mesh.type, "application/octet-stream");
  EXPECT_EQ(mesh.content(), reader_.Mesh(0));
}

TEST_F(SceneFilesTest, ANumberThatIsNoneIs404) {
  for (const char* index : {"1", "-1", "", "x", "0x", "00000000000000000000", "1e0", "+0", "0/"}) {
    const unsigned status = dut_.Mesh(index).status;
    EXPECT_EQ(status, std::string{index} == "00000000000000000000" ? 200u : 404u) << index;
  }
  EXPECT_THAT(dut_.HeightField("0").body, HasSubstr("no height field 0: the scene has 0"));
}

TEST_F(SceneFilesTest, AModelSaysForWhichVersionItIs) {
  const HttpReply model = dut_.Model();
  EXPECT_EQ(model.fields.at(0).first, "X-Mujoco-Version");
  EXPECT_EQ(model.fields.at(0).second, mj_versionString());
}

TEST_F(SceneFilesTest, OneCopyIsSentToAllWhoReadItAndNoneIsKept) {
  HttpReply one = dut_.Model();
  const std::weak_ptr<const std::string> kept = one.shared;
  EXPECT_EQ(dut_.Model().shared, one.shared);
  one = {};
  EXPECT_TRUE(kept.expired());
}

}  // namespace
}  // namespace understudy::server
