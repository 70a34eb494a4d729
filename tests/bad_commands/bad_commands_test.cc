// Every row of the table for every robot, through DDS.
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "tests/bad_commands/rig.h"
#include "tests/bad_commands/rows.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/robots.h"

namespace understudy::bad_commands {
namespace {

bool IsFor(const Row& row, const robot::RobotSpec& spec) { return !row.is_for || row.is_for(spec); }

class BadCommandsTest : public test::MujocoTest, public testing::WithParamInterface<std::string> {};

TEST_P(BadCommandsTest, AreMetAsTheTableSaysAndTheNextGoodOneIsFollowed) {
  Rig rig(GetParam());
  for (const Row& row : Rows()) {
    if (row.service || !IsFor(row, rig.spec())) continue;
    SCOPED_TRACE(row.sends);
    rig.Restart();
    row.play(&rig);
    ASSERT_FALSE(HasFatalFailure());
    EXPECT_GT(rig.lowstates(), 0);

    const std::uint64_t accepted = rig.accepted();
    const Message good = rig.Reach(0.02);
    rig.Send(good);
    rig.Tick(25);
    EXPECT_EQ(rig.accepted(), accepted + 1);
    EXPECT_EQ(rig.gate(), authority::GateState::kFollowing);
    EXPECT_EQ(rig.commanded(), good.slots[wire::SlotOf(rig.spec().motors[0])].q);
  }
}

TEST_P(BadCommandsTest, AreMetAsTheTableSaysBesideAMotionService) {
  Rig rig(GetParam(), true);
  for (const Row& row : Rows()) {
    if (!row.service || !IsFor(row, rig.spec())) continue;
    SCOPED_TRACE(row.sends);
    rig.Restart();
    row.play(&rig);
  }
}

TEST_P(BadCommandsTest, AreFortyKindsOrMore) {
  const robot::RobotSpec& spec = test::ShippedRobot(GetParam());
  int kinds = 0;
  for (const Row& row : Rows()) kinds += IsFor(row, spec) ? 1 : 0;
  EXPECT_GE(kinds, 40);
}

INSTANTIATE_TEST_SUITE_P(Robots, BadCommandsTest, testing::ValuesIn(test::Robots()),
                         [](const auto& robot) { return robot.param; });

TEST(BadCommandsReferenceTest, IsWhatDocsBadCommandsMdHas) {
  std::ifstream file(UNDERSTUDY_SOURCE_DIR "/docs/reference/bad_commands.md", std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  if (text == Reference()) return;
  std::ofstream("bad_commands.md", std::ios::binary) << Reference();
  FAIL() << "docs/reference/bad_commands.md is not what the table says; copy "
         << std::filesystem::absolute("bad_commands.md") << " over it";
}

}  // namespace
}  // namespace understudy::bad_commands
