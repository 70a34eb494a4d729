#include "record/truth.h"

#include <cmath>

#include <gmock/gmock.h>

#include "tests/record/mcap_files.h"

namespace understudy::record {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(TruthTest, IsReadAsItWasWritten) {
  BytesOut out;
  EncodeTruth({.step = 7,
               .time = 0.007,
               .qpos = {1, 2, 3},
               .qvel = {},
               .tau = {-4},
               .foot_force = {5, 6},
               .crane_tension = 8,
               .nearest_obstacle = 0.9,
               .hand_force = {10, 11},
               .touch = {12, 13}},
              &out);
  const Truth truth = DecodeTruth(out.span());
  EXPECT_EQ(truth.step, 7);
  EXPECT_EQ(truth.time, 0.007);
  EXPECT_THAT(truth.qpos, ElementsAre(1, 2, 3));
  EXPECT_THAT(truth.qvel, IsEmpty());
  EXPECT_THAT(truth.tau, ElementsAre(-4));
  EXPECT_THAT(truth.foot_force, ElementsAre(5, 6));
  EXPECT_EQ(truth.crane_tension, 8);
  EXPECT_EQ(truth.nearest_obstacle, 0.9);
  EXPECT_THAT(truth.hand_force, ElementsAre(10, 11));
  EXPECT_THAT(truth.touch, ElementsAre(12, 13));
}

// What was added since stands at the end: the nearest obstacle, then empty lists of hands and
// of pads.
constexpr std::size_t kPads = 4, kHands = 4, kObstacle = 8;

TEST(TruthTest, HasNoNearestObstacleAndNoHandsInOlderRecordings) {
  BytesOut out;
  EncodeTruth({.step = 7, .crane_tension = 8, .nearest_obstacle = 0.9}, &out);
  EXPECT_THAT(DecodeTruth(out.span().first(out.size() - kPads)).touch, IsEmpty());
  const Truth older = DecodeTruth(out.span().first(out.size() - kPads - kHands));
  EXPECT_EQ(older.nearest_obstacle, 0.9);
  EXPECT_THAT(older.hand_force, IsEmpty());
  const Truth oldest = DecodeTruth(out.span().first(out.size() - kPads - kHands - kObstacle));
  EXPECT_EQ(oldest.crane_tension, 8);
  EXPECT_TRUE(std::isnan(oldest.nearest_obstacle));
  EXPECT_THAT(oldest.hand_force, IsEmpty());
}

TEST(TruthTest, IsCdr) {
  BytesOut out;
  EncodeTruth({.step = 1, .qpos = {2}}, &out);
  // Head, step, time, count of qpos and its number 8 bytes on, three empty sequences, tension,
  // obstacle, two empty sequences.
  EXPECT_EQ(out.size(), 4 + 8 + 8 + 4 + 4 + 8 + 3 * 4 + 4 + 8 + 8 + 2 * 4);
  EXPECT_EQ(TextOf(out.span().first(8)), std::string("\0\1\0\0\1\0\0\0", 8));
}

TEST(TruthTest, RefusesEveryPartOfIt) {
  BytesOut out;
  EncodeTruth({.step = 1, .qpos = {2, 3}, .tau = {4}}, &out);
  const std::size_t old = out.size() - kPads, older = old - kHands, oldest = older - kObstacle;
  for (std::size_t size = 0; size < out.size(); ++size) {
    if (size == old || size == older || size == oldest) continue;
    EXPECT_THROW(DecodeTruth(out.span().first(size)), RecordError) << size;
  }
}

Damage SomeDamage() {
  robot::DamageTotals sheet{.motors = {{.at_torque_limit = 1, .hottest_c = 2}, {.largest_jump = 3}},
                            .time = 4,
                            .energy = 5,
                            .worst_tilt = 6,
                            .falls = 7};
  return {.step = 8,
          .sheet = sheet,
          .trip_c = 9,
          .joints = {"hip", "knee"},
          .torque_limit = {10, 11},
          .speed_limit = {12, 13},
          .jump_limit = {14, 15},
          .limits = {{"shock", 16, "m/s²", "assumed: so"}, {"falls", 17, "", "vendor: so"}}};
}

TEST(DamageTest, IsReadAsItWasWritten) {
  BytesOut out;
  EncodeDamage(SomeDamage(), &out);
  const Damage damage = DecodeDamage(out.span());
  EXPECT_EQ(damage.step, 8);
  EXPECT_EQ(damage.sheet.time, 4);
  EXPECT_EQ(damage.sheet.energy, 5);
  EXPECT_EQ(damage.sheet.worst_tilt, 6);
  EXPECT_EQ(damage.sheet.falls, 7);
  EXPECT_EQ(damage.sheet.motors[0].at_torque_limit, 1);
  EXPECT_EQ(damage.sheet.motors[0].hottest_c, 2);
  EXPECT_EQ(damage.sheet.motors[1].largest_jump, 3);
  EXPECT_EQ(damage.trip_c, 9);
  EXPECT_THAT(damage.joints, ElementsAre("hip", "knee"));
  EXPECT_THAT(damage.torque_limit, ElementsAre(10, 11));
  EXPECT_THAT(damage.speed_limit, ElementsAre(12, 13));
  EXPECT_THAT(damage.jump_limit, ElementsAre(14, 15));
  ASSERT_EQ(damage.limits.size(), 2U);
  EXPECT_EQ(damage.limits[0].figure, "shock");
  EXPECT_EQ(damage.limits[0].unit, "m/s²");
  EXPECT_EQ(damage.limits[1].limit, 17);
  EXPECT_EQ(damage.limits[1].source, "vendor: so");
}

TEST(DamageTest, RefusesEveryPartOfIt) {
  BytesOut out;
  EncodeDamage(SomeDamage(), &out);
  for (std::size_t size = 0; size < out.size(); ++size) {
    EXPECT_THROW(DecodeDamage(out.span().first(size)), RecordError) << size;
  }
}

TEST(DamageTest, RefusesFewerLimitsThanJoints) {
  Damage damage = SomeDamage();
  damage.speed_limit.pop_back();
  BytesOut out;
  EncodeDamage(damage, &out);
  EXPECT_THROW(DecodeDamage(out.span()), RecordError);
}

TEST(EventTest, IsReadAsItWasWritten) {
  BytesOut out;
  EncodeEvent({.step = 3, .time = 0.003, .kind = "refused", .text = "no", .detail = "{}"}, &out);
  const RecordedEvent event = DecodeEvent(out.span());
  EXPECT_EQ(event.step, 3);
  EXPECT_EQ(event.time, 0.003);
  EXPECT_EQ(event.kind, "refused");
  EXPECT_EQ(event.text, "no");
  EXPECT_EQ(event.detail, "{}");
}

TEST(EventTest, RefusesBigEndian) {
  BytesOut out;
  EncodeEvent({}, &out);
  std::string text = TextOf(out.span());
  text[1] = 0;
  EXPECT_THROW(DecodeEvent(AsBytes(text)), RecordError);
}

}  // namespace
}  // namespace understudy::record
