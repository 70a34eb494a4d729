#include "sensors/encoders.h"

#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace understudy::sensors {
namespace {

class EncodersTest : public testing::Test {
 protected:
  void Step(double q = 1, double dq = 2) {
    encoders_.Step(std::vector{q, q}, std::vector{dq, dq}, faults_);
  }
  double q() const { return encoders_.q()[0]; }
  double dq() const { return encoders_.dq()[0]; }

  std::vector<robot::EncoderEffects> faults_{2};
  Encoders encoders_{{0, 0}, 1};
};

TEST_F(EncodersTest, ReadTheTruthWithoutFaults) {
  Step();
  EXPECT_EQ(q(), 1);
  EXPECT_EQ(dq(), 2);
}

TEST_F(EncodersTest, AddTheErrorOfTheirZeroToAnglesAlone) {
  encoders_ = {{0.25, 0}, 1};
  Step();
  EXPECT_EQ(q(), 1.25);
  EXPECT_EQ(dq(), 2);
  EXPECT_EQ(encoders_.q()[1], 1);
}

TEST_F(EncodersTest, ReadNothingWhileDead) {
  faults_[0].dead = true;
  Step();
  EXPECT_EQ(q(), 0);
  EXPECT_EQ(dq(), 0);
  EXPECT_EQ(encoders_.q()[1], 1);
}

TEST_F(EncodersTest, ReadWhatTheyReadWhileStuckAndTheTruthAfterwards) {
  Step(1);
  faults_[0].stuck = true;
  Step(5);
  EXPECT_EQ(q(), 1);
  EXPECT_EQ(dq(), 0);
  faults_[0].stuck = false;
  Step(5);
  EXPECT_EQ(q(), 5);
}

TEST_F(EncodersTest, AddTheirOffsetToAnglesAlone) {
  faults_[0].offset = 0.25;
  Step();
  EXPECT_EQ(q(), 1.25);
  EXPECT_EQ(dq(), 2);
}

TEST_F(EncodersTest, SpreadWithTheStandardDeviationOfTheirNoise) {
  faults_[0].noise = 0.1;
  double sum = 0, square = 0;
  constexpr int kReadings = 20'000;
  for (int i = 0; i < kReadings; ++i) {
    Step();
    sum += q() - 1;
    square += (q() - 1) * (q() - 1);
  }
  EXPECT_NEAR(sum / kReadings, 0, 0.003);
  EXPECT_NEAR(std::sqrt(square / kReadings), 0.1, 0.003);
}

TEST_F(EncodersTest, ReadAnotherAngleEachTimeWithGarbage) {
  faults_[0].garbage = true;
  std::set<double> seen;
  for (int i = 0; i < 100; ++i) {
    Step();
    EXPECT_LE(std::abs(q()), 2 * std::numbers::pi);
    seen.insert(q());
  }
  EXPECT_EQ(seen.size(), 100U);
  EXPECT_GT(*seen.rbegin(), 5);
  EXPECT_LT(*seen.begin(), -5);
}

}  // namespace
}  // namespace understudy::sensors
