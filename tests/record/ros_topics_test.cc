#include "record/ros_topics.h"

#include <gmock/gmock.h>

#include "tests/record/mcap_files.h"

namespace understudy::record {
namespace {

using mjcf::SceneShape;
using mjcf::TreeJoint;
using ::testing::ElementsAre;
using ::testing::Pair;

constexpr std::uint64_t kTime = 5'000'000'007;  // ns

// Reads what stands in a message one after the other.
class Reading {
 public:
  explicit Reading(const BytesOut& out) : in_(out.span()) {
    EXPECT_EQ(TextOf(in_.TakeRaw(4)), std::string("\0\1\0\0", 4));
  }
  template <typename Number>
  Number Take() {
    in_.Align(sizeof(Number), 4);
    return in_.Take<Number>();
  }
  std::string Text() {
    const std::string text = TextOf(in_.TakeRaw(Take<std::uint32_t>()));
    EXPECT_EQ(text.back(), '\0');
    return text.substr(0, text.size() - 1);
  }
  std::vector<double> Numbers(std::size_t count) {
    std::vector<double> numbers;
    while (numbers.size() < count) numbers.push_back(Take<double>());
    return numbers;
  }
  std::vector<double> Sequence() { return Numbers(Take<std::uint32_t>()); }
  void ExpectTime() {
    EXPECT_EQ(Take<std::int32_t>(), 5);
    EXPECT_EQ(Take<std::uint32_t>(), 7U);
  }
  std::size_t left() const { return in_.remaining(); }

 private:
  BytesIn in_;
};

// A base, a link that turns about z 1 m above it, and one that is fixed to that.
RosRobot Robot(bool free) {
  RosRobot robot;
  robot.tree.base = "base";
  robot.tree.base_qpos = free ? 0 : -1;
  robot.tree.X_WB = Eigen::Translation3d(7, 8, 9);
  robot.tree.joints = {{.name = "turn",
                        .kind = TreeJoint::Kind::kHinge,
                        .parent = "base",
                        .child = "arm",
                        .X_PC = Eigen::Isometry3d(Eigen::Translation3d(0, 0, 1)),
                        .axis = {0, 0, 1},
                        .qpos = free ? 7 : 0,
                        .dof = free ? 6 : 0},
                       {.name = "tip_fixed",
                        .parent = "arm",
                        .child = "tip",
                        .X_PC = Eigen::Isometry3d(Eigen::Translation3d(2, 0, 0))}};
  robot.motors = {0, -1};
  return robot;
}

const Truth kTruth{
    .qpos = {1, 2, 3, 0, 1, 0, 0, M_PI / 2}, .qvel = {0, 0, 0, 0, 0, 0, 0.5}, .tau = {4}};

std::vector<std::pair<std::string, std::string>> Links(Reading* in,
                                                       std::vector<std::vector<double>>* poses) {
  std::vector<std::pair<std::string, std::string>> links;
  for (auto left = in->Take<std::uint32_t>(); left > 0; --left) {
    in->ExpectTime();
    std::string parent = in->Text();
    links.emplace_back(std::move(parent), in->Text());
    poses->push_back(in->Numbers(7));
  }
  EXPECT_EQ(in->left(), 0U);
  return links;
}

TEST(RosTopicsTest, HaveTheBaseAndWhatTurnsInTf) {
  BytesOut out;
  EncodeTf(Robot(true), kTruth, kTime, &out);
  Reading in(out);
  std::vector<std::vector<double>> poses;
  EXPECT_THAT(Links(&in, &poses), ElementsAre(Pair("world", "base"), Pair("base", "arm")));
  EXPECT_THAT(poses[0], ElementsAre(1, 2, 3, 1, 0, 0, 0));  // x, y, z, w
  EXPECT_NEAR(poses[1][5], std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(poses[1][6], std::sqrt(0.5), 1e-12);
  EXPECT_EQ(poses[1][2], 1);
}

TEST(RosTopicsTest, HaveWhatNeverMovesInTfStatic) {
  BytesOut out;
  std::vector<std::vector<double>> poses;
  EncodeTfStatic(Robot(true), kTime, &out);
  Reading in(out);
  EXPECT_THAT(Links(&in, &poses), ElementsAre(Pair("arm", "tip")));
  EXPECT_THAT(poses[0], ElementsAre(2, 0, 0, 0, 0, 0, 1));
}

TEST(RosTopicsTest, HaveAFixedBaseInTfStatic) {
  BytesOut out;
  std::vector<std::vector<double>> poses;
  EncodeTfStatic(Robot(false), kTime, &out);
  Reading fixed(out);
  EXPECT_THAT(Links(&fixed, &poses), ElementsAre(Pair("world", "base"), Pair("arm", "tip")));
  EXPECT_THAT(poses[0], ElementsAre(7, 8, 9, 0, 0, 0, 1));
  EncodeTf(Robot(false), {.qpos = {0}}, kTime, &out);
  Reading moving(out);
  EXPECT_THAT(Links(&moving, &poses), ElementsAre(Pair("base", "arm")));
}

TEST(RosTopicsTest, HaveJointsWithTheTorqueOfTheirMotors) {
  RosRobot robot = Robot(true);
  for (const double tau : {4.0, 0.0}) {
    BytesOut out;
    EncodeJointStates(robot, kTruth, kTime, &out);
    Reading in(out);
    in.ExpectTime();
    EXPECT_EQ(in.Text(), "");
    EXPECT_EQ(in.Take<std::uint32_t>(), 1U);
    EXPECT_EQ(in.Text(), "turn");
    EXPECT_THAT(in.Sequence(), ElementsAre(M_PI / 2));
    EXPECT_THAT(in.Sequence(), ElementsAre(0.5));
    EXPECT_THAT(in.Sequence(), ElementsAre(tau));
    EXPECT_EQ(in.left(), 0U);
    robot.motors[0] = -1;  // now it has none
  }
}

TEST(RosTopicsTest, HaveTimeAndDescription) {
  BytesOut out;
  EncodeClock(kTime, &out);
  Reading clock(out);
  clock.ExpectTime();
  EXPECT_EQ(clock.left(), 0U);
  RosRobot robot;
  robot.urdf = "<robot/>";
  EncodeRobotDescription(robot, &out);
  EXPECT_EQ(Reading(out).Text(), "<robot/>");
}

TEST(RosTopicsTest, HaveAMarkerOfItsKindForEachShape) {
  RosRobot robot;
  for (const auto kind : {SceneShape::Kind::kBox, SceneShape::Kind::kEllipsoid,
                          SceneShape::Kind::kCylinder, SceneShape::Kind::kTriangles}) {
    robot.scene.push_back({.name = "one", .kind = kind, .size = {1, 2, 3}, .rgba = {0, 0, 1, 1}});
  }
  robot.scene.back().corners = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  BytesOut out;
  EncodeScene(robot, kTime, &out);
  Reading in(out);
  ASSERT_EQ(in.Take<std::uint32_t>(), 4U);
  int id = 0;
  for (const std::int32_t type : {1, 2, 3, 11}) {
    in.ExpectTime();
    EXPECT_EQ(in.Text(), "world");
    EXPECT_EQ(in.Text(), "one");
    EXPECT_EQ(in.Take<std::int32_t>(), id++);
    EXPECT_EQ(in.Take<std::int32_t>(), type);
    EXPECT_EQ(in.Take<std::int32_t>(), 0);  // it is added
    EXPECT_THAT(in.Numbers(7), ElementsAre(0, 0, 0, 0, 0, 0, 1));
    EXPECT_THAT(in.Numbers(3), ElementsAre(1, 2, 3));
    for (const float part : {0.0F, 0.0F, 1.0F, 1.0F}) EXPECT_EQ(in.Take<float>(), part);
    EXPECT_EQ(in.Take<std::int64_t>(), 0);  // for ever
    EXPECT_EQ(in.Take<std::uint8_t>(), 0);
    const auto corners = in.Take<std::uint32_t>();
    EXPECT_EQ(corners, type == 11 ? 3U : 0U);
    if (corners > 0) {
      EXPECT_THAT(in.Numbers(9), ElementsAre(1, 0, 0, 0, 1, 0, 0, 0, 1));
    }
    EXPECT_EQ(in.Take<std::uint32_t>(), 0U);  // colours
    EXPECT_EQ(in.Text(), "");
    in.Take<std::uint32_t>();  // the time of a texture
    in.Take<std::uint32_t>();
    for (int i = 0; i < 2; ++i) EXPECT_EQ(in.Text(), "");
    for (int i = 0; i < 2; ++i) EXPECT_EQ(in.Take<std::uint32_t>(), 0U);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(in.Text(), "");
    EXPECT_EQ(in.Take<std::uint32_t>(), 0U);
    EXPECT_EQ(in.Take<std::uint8_t>(), 0);
  }
  EXPECT_EQ(in.left(), 0U);
}

}  // namespace
}  // namespace understudy::record
