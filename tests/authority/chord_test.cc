#include "authority/chord.h"

#include <gtest/gtest.h>

#include "base/errors.h"

namespace understudy::authority {
namespace {

constexpr std::uint16_t kL2 = 0x20, kA = 0x100, kB = 0x200, kR2 = 0x10, kStart = 4;

class ChordReaderTest : public ::testing::Test {
 protected:
  ChordReaderTest()
      : reader_({MakeChord({.keys = "L2+R2", .does = "debug", .from = {0, 1}}, ""),
                 MakeChord({.keys = "L2+B", .does = "damp"}, ""),
                 MakeChord({.keys = "L2+A", .does = "set_fsm", .value = 4, .from = {1}}, ""),
                 MakeChord({.keys = "START", .clicks = 2, .does = "balance_stand"}, "")}) {}

  std::optional<MotionGoal> Read(std::uint16_t keys, double t, int state = 1) {
    const Chord* chord = reader_.Read(keys, state, t);
    if (chord == nullptr || !chord->goal) return std::nullopt;
    return chord->goal;
  }

  ChordReader reader_;
};

TEST_F(ChordReaderTest, ActsOnceWhenTheLastKeyGoesDown) {
  EXPECT_EQ(Read(kL2, 0), std::nullopt);
  EXPECT_EQ(Read(kL2 | kB, 0.1), MotionGoal(goal::Damp{}));
  EXPECT_EQ(Read(kL2 | kB, 0.2), std::nullopt);
  EXPECT_EQ(Read(kL2, 0.3), std::nullopt);
  EXPECT_EQ(Read(kL2 | kB, 1), MotionGoal(goal::Damp{}));
}

TEST_F(ChordReaderTest, WantsExactlyItsKeys) {
  EXPECT_EQ(Read(kB, 0), std::nullopt);
  EXPECT_EQ(Read(kL2 | kB | kA, 1), std::nullopt);
}

TEST_F(ChordReaderTest, PassesTheValueOn) {
  const Chord* chord = reader_.Read(kL2 | kA, 1, 0);
  ASSERT_NE(chord, nullptr);
  EXPECT_EQ(chord->goal, MotionGoal(goal::SetFsm{4}));
}

TEST_F(ChordReaderTest, WorksInItsStatesOnly) {
  EXPECT_EQ(Read(kL2 | kA, 0, 500), std::nullopt);
  EXPECT_EQ(Read(0, 1, 500), std::nullopt);
  EXPECT_EQ(Read(kL2 | kB, 2, 500), MotionGoal(goal::Damp{}));
}

TEST_F(ChordReaderTest, TellsDebugByHavingNoGoal) {
  const Chord* chord = reader_.Read(kL2 | kR2, 1, 0);
  ASSERT_NE(chord, nullptr);
  EXPECT_FALSE(chord->goal.has_value());
  EXPECT_TRUE(reader_.knows_debug());
  EXPECT_FALSE(ChordReader({}).knows_debug());
}

TEST_F(ChordReaderTest, CountsTwoClicksWithinHalfASecond) {
  EXPECT_EQ(Read(kStart, 0), std::nullopt);
  EXPECT_EQ(Read(0, 0.1), std::nullopt);
  EXPECT_EQ(Read(kStart, 0.4), MotionGoal(goal::BalanceStand{}));
  Read(0, 0.5);
  EXPECT_EQ(Read(kStart, 0.6), std::nullopt);  // the third begins anew
  Read(0, 0.7);
  EXPECT_EQ(Read(kStart, 2), std::nullopt);
}

TEST(MakeChordTest, RefusesKeysAndWordsThatDoNotExist) {
  EXPECT_THROW(MakeChord({.keys = "L9", .does = "damp"}, "x"), ConfigError);
  EXPECT_THROW(MakeChord({.keys = "L2", .does = "dampp"}, "x"), ConfigError);
}

TEST(ChordTest, MakesGoalsOfGaitsAndGestures) {
  using enum goal::GaitName;
  using enum goal::GestureName;
  for (const auto& [word, wish] :
       std::vector<std::pair<const char*, MotionGoal>>{{"free_walk", goal::Gait{kFree}},
                                                       {"static_walk", goal::Gait{kStatic}},
                                                       {"trot_run", goal::Gait{kRun}},
                                                       {"classic_walk", goal::Gait{kClassic}},
                                                       {"economic_gait", goal::Gait{kEconomic}},
                                                       {"trot", goal::Gait{kTrot}},
                                                       {"stairs", goal::Gait{kStairs}},
                                                       {"hello", goal::Gesture{kHello}},
                                                       {"stretch", goal::Gesture{kStretch}},
                                                       {"dance1", goal::Gesture{kDance1}},
                                                       {"heart", goal::Gesture{kHeart}},
                                                       {"sit", goal::Sit{}}}) {
    EXPECT_EQ(MakeChord({.keys = "R1+A", .does = word}, "").goal, wish) << word;
  }
}

}  // namespace
}  // namespace understudy::authority
