#include "wire/rounded.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include <gmock/gmock.h>

namespace understudy::wire {
namespace {

TEST(RoundedTest, RoundsToTheNearest) {
  EXPECT_EQ(Rounded<std::int16_t>(-2.6), -3);
  EXPECT_EQ(Rounded<std::uint8_t>(44.4), 44);
}

TEST(RoundedTest, StaysWithinItsType) {
  EXPECT_EQ(Rounded<std::uint8_t>(-1), 0);
  EXPECT_EQ(Rounded<std::uint8_t>(1e9), 255);
  EXPECT_EQ(Rounded<std::int16_t>(-1e9), -32768);
  EXPECT_EQ(Rounded<std::uint32_t>(1e12), std::numeric_limits<std::uint32_t>::max());
}

TEST(RoundedTest, StaysWithinItsBounds) {
  EXPECT_EQ(Rounded<std::int16_t>(-3, 0, 4095), 0);
  EXPECT_EQ(Rounded<std::int16_t>(5000, 0, 4095), 4095);
}

TEST(RoundedTest, MakesTheLowestOfNaN) { EXPECT_EQ(Rounded<std::int16_t>(std::nan(""), 7, 9), 7); }

}  // namespace
}  // namespace understudy::wire
