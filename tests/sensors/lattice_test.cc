#include "sensors/lattice.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace understudy::sensors {
namespace {

// So that -0 is not 0 and NaN is itself.
std::uint64_t Bits(double value) { return std::bit_cast<std::uint64_t>(value); }

void ExpectAsRound(double value, double step) {
  EXPECT_EQ(Bits(OnLattice(value, step)), Bits(std::round(value / step) * step))
      << value << " on a lattice of " << step;
}

TEST(LatticeTest, IsThatOfRoundToTheLastBit) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 200'000; ++i) {
    const double value = static_cast<double>(static_cast<std::int64_t>(random())) * 0x1p-60;
    ExpectAsRound(value, 0.000263672);
    ExpectAsRound(value, 1);
  }
}

TEST(LatticeTest, GoesAwayFromZeroInTheMiddle) {
  for (const double value : {0.5, 1.5, 2.5, -0.5, -1.5, -2.5, 1e15 + 0.5, -1e15 - 0.5}) {
    ExpectAsRound(value, 1);
  }
  EXPECT_EQ(OnLattice(2.5, 1), 3);
  EXPECT_EQ(OnLattice(-2.5, 1), -3);
}

TEST(LatticeTest, KeepsTheSignOfZeroAndWhatIsNoNumber) {
  for (const double value :
       {0.0, -0.0, 0.3, -0.3, std::nextafter(0.5, 0), -std::nextafter(0.5, 0), 0x1p51, 0x1p51 + 0.5,
        -0x1p51 - 0.5, 0x1p53, 1e300, std::numeric_limits<double>::denorm_min(),
        std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
        std::numeric_limits<double>::quiet_NaN()}) {
    ExpectAsRound(value, 1);
  }
}

}  // namespace
}  // namespace understudy::sensors
