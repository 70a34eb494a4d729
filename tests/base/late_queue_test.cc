#include "base/late_queue.h"

#include <vector>

#include <gtest/gtest.h>

namespace understudy {
namespace {

std::vector<int> Taken(LateQueue<int>* queue, double now) {
  std::vector<int> taken;
  for (const int* value = nullptr; (value = queue->Due(now)) != nullptr; queue->Pop()) {
    taken.push_back(*value);
  }
  return taken;
}

TEST(LateQueueTest, GivesEachValueFromItsTimeOnAndOnce) {
  LateQueue<int> queue;
  *queue.Push(1) = 10;
  *queue.Push(2) = 20;
  EXPECT_TRUE(Taken(&queue, 0.9).empty());
  EXPECT_EQ(Taken(&queue, 1), std::vector<int>{10});
  EXPECT_EQ(Taken(&queue, 5), std::vector<int>{20});
  EXPECT_TRUE(queue.empty());
}

TEST(LateQueueTest, LetsNoneOvertakeTheOneBefore) {
  LateQueue<int> queue;
  *queue.Push(3) = 1;
  *queue.Push(2) = 2;
  EXPECT_TRUE(Taken(&queue, 2.5).empty());
  EXPECT_EQ(Taken(&queue, 3), (std::vector<int>{1, 2}));
}

TEST(LateQueueTest, KeepsItsOrderAsItGrowsAroundItsEnd) {
  LateQueue<int> queue;
  int next = 0, taken = 0;
  for (int round = 1; round < 40; ++round) {
    for (int i = 0; i < round; ++i, ++next) *queue.Push(next) = next;
    for (int i = 0; i < round / 2; ++i, ++taken) {
      ASSERT_EQ(*queue.Due(1e9), taken);
      queue.Pop();
    }
  }
  for (; !queue.empty(); queue.Pop()) ASSERT_EQ(*queue.Due(1e9), taken++);
  EXPECT_EQ(taken, next);
}

TEST(LateQueueTest, HasNoRoomBeyondItsMost) {
  LateQueue<int> queue;
  for (std::size_t i = 0; i < LateQueue<int>::kMost; ++i) ASSERT_NE(queue.Push(0), nullptr);
  EXPECT_EQ(queue.Push(0), nullptr);
  queue.Clear();
  EXPECT_NE(queue.Push(0), nullptr);
}

}  // namespace
}  // namespace understudy
