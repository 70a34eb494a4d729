#include "base/spsc_ring.h"

#include <thread>

#include <gtest/gtest.h>

namespace understudy {
namespace {

TEST(SpscRingTest, GivesBackInOrderWhatWasPutIn) {
  SpscRing<int> ring(2);
  EXPECT_EQ(ring.Front(), nullptr);
  for (const int number : {1, 2}) {
    *ring.Claim() = number;
    ring.Commit();
  }
  EXPECT_EQ(*ring.Front(), 1);
  ring.Pop();
  EXPECT_EQ(*ring.Front(), 2);
  ring.Pop();
  EXPECT_EQ(ring.Front(), nullptr);
  EXPECT_EQ(ring.dropped(), 0U);
}

TEST(SpscRingTest, HasNoRoomForMoreThanItsSlotsAndCountsThat) {
  SpscRing<int> ring(1);
  *ring.Claim() = 1;
  ring.Commit();
  EXPECT_EQ(ring.Claim(), nullptr);
  EXPECT_EQ(ring.dropped(), 1U);
  EXPECT_EQ(*ring.Front(), 1);
}

TEST(SpscRingTest, CarriesFromThreadToThread) {
  constexpr int kNumbers = 10'000;
  SpscRing<int> ring(64);
  std::jthread writer([&] {
    for (int number = 0; number < kNumbers;) {
      int* slot = ring.Claim();
      if (slot == nullptr) {
        std::this_thread::yield();
        continue;
      }
      *slot = number++;
      ring.Commit();
    }
  });
  for (int number = 0; number < kNumbers;) {
    const int* slot = ring.Front();
    if (slot == nullptr) {
      std::this_thread::yield();
      continue;
    }
    ASSERT_EQ(*slot, number++);
    ring.Pop();
  }
}

}  // namespace
}  // namespace understudy
