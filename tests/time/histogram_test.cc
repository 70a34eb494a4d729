#include "time/histogram.h"

#include "gtest/gtest.h"

namespace understudy::time {
namespace {

TEST(HistogramTest, CountsWhatIsUpToABoundInItsBucket) {
  Histogram dut;
  dut.Add(0);
  dut.Add(5e-6);
  dut.Add(6e-6);
  dut.Add(100);
  EXPECT_EQ(dut.counts[0], 2u);
  EXPECT_EQ(dut.counts[1], 1u);
  EXPECT_EQ(dut.counts.back(), 1u);
  EXPECT_DOUBLE_EQ(dut.sum, 100 + 11e-6);
}

}  // namespace
}  // namespace understudy::time
