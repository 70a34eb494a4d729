#include "record/truth.h"

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
               .crane_tension = 8},
              &out);
  const Truth truth = DecodeTruth(out.span());
  EXPECT_EQ(truth.step, 7);
  EXPECT_EQ(truth.time, 0.007);
  EXPECT_THAT(truth.qpos, ElementsAre(1, 2, 3));
  EXPECT_THAT(truth.qvel, IsEmpty());
  EXPECT_THAT(truth.tau, ElementsAre(-4));
  EXPECT_THAT(truth.foot_force, ElementsAre(5, 6));
  EXPECT_EQ(truth.crane_tension, 8);
}

TEST(TruthTest, IsCdr) {
  BytesOut out;
  EncodeTruth({.step = 1, .qpos = {2}}, &out);
  // Head, step, time, count of qpos and its number 8 bytes on, three empty sequences, tension.
  EXPECT_EQ(out.size(), 4 + 8 + 8 + 4 + 4 + 8 + 3 * 4 + 4 + 8);
  EXPECT_EQ(TextOf(out.span().first(8)), std::string("\0\1\0\0\1\0\0\0", 8));
}

TEST(TruthTest, RefusesEveryPartOfIt) {
  BytesOut out;
  EncodeTruth({.step = 1, .qpos = {2, 3}, .tau = {4}}, &out);
  for (std::size_t size = 0; size < out.size(); ++size) {
    EXPECT_THROW(DecodeTruth(out.span().first(size)), RecordError) << size;
  }
}

TEST(EventTest, IsReadAsItWasWritten) {
  BytesOut out;
  EncodeEvent({.step = 3, .time = 0.003, .kind = "refused", .text = "no", .detail = "{}"}, &out);
  const Event event = DecodeEvent(out.span());
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
