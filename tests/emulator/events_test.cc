#include "emulator/events.h"

#include <atomic>
#include <thread>

#include <gtest/gtest.h>

namespace understudy::emulator {
namespace {

// Everything in it says `number`.
Event Numbered(std::int64_t number) {
  const auto value = static_cast<double>(number);
  Event event{.step = number,
              .time = value,
              .kind = EventKind::kScript,
              .numbers = {value, value, value, value}};
  CopyText(std::to_string(number), &event.text);
  return event;
}

bool IsWhole(const Event& event) {
  const Event expected = Numbered(event.step);
  return event.time == expected.time && event.numbers == expected.numbers &&
         event.text == expected.text;
}

TEST(EventRingTest, GivesEveryReaderAllInOrder) {
  EventRing ring;
  EventRing::Reader one(&ring);
  EventRing::Reader other(&ring);
  Event event;
  EXPECT_FALSE(one.Next(&event));
  for (int i = 0; i < 10; ++i) ring.Append(Numbered(i));
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(one.Next(&event));
    EXPECT_EQ(event.step, i);
    EXPECT_TRUE(IsWhole(event));
  }
  EXPECT_FALSE(one.Next(&event));
  ASSERT_TRUE(other.Next(&event));
  EXPECT_EQ(event.step, 0);
}

TEST(EventRingTest, TellsAReaderThatFellBehindHowManyItLost) {
  EventRing ring;
  EventRing::Reader reader(&ring);
  for (std::size_t i = 0; i < EventRing::kCapacity + 5; ++i) {
    ring.Append(Numbered(static_cast<std::int64_t>(i)));
  }
  Event event;
  ASSERT_TRUE(reader.Next(&event));
  EXPECT_EQ(event.kind, EventKind::kLost);
  EXPECT_EQ(event.numbers[0], 5);
  for (std::size_t i = 5; i < EventRing::kCapacity + 5; ++i) {
    ASSERT_TRUE(reader.Next(&event));
    EXPECT_EQ(event.step, static_cast<std::int64_t>(i));
  }
  EXPECT_FALSE(reader.Next(&event));
}

TEST(EventRingTest, NeverGivesHalfAnEventHoweverFastTheyCome) {
  EventRing ring;
  constexpr std::int64_t kEvents = 30 * static_cast<std::int64_t>(EventRing::kCapacity);
  std::atomic<int> torn = 0;
  std::atomic<int> miscounted = 0;
  const auto read = [&] {
    EventRing::Reader reader(&ring);
    std::int64_t expected = 0;
    for (Event event; expected < kEvents;) {
      if (!reader.Next(&event)) continue;
      if (event.kind == EventKind::kLost) {
        expected += static_cast<std::int64_t>(event.numbers[0]);
        continue;
      }
      if (!IsWhole(event)) ++torn;
      if (event.step != expected) ++miscounted;
      ++expected;
    }
  };
  std::thread one(read);
  std::thread other(read);
  for (std::int64_t i = 0; i < kEvents; ++i) ring.Append(Numbered(i));
  one.join();
  other.join();
  EXPECT_EQ(torn, 0);
  EXPECT_EQ(miscounted, 0);
}

TEST(EventTest, CutsTextsThatAreTooLong) {
  Event event;
  CopyText(std::string(200, 'x'), &event.text);
  EXPECT_EQ(std::string(event.text.data()), std::string(119, 'x'));
  CopyText("y", &event.text);
  EXPECT_STREQ(event.text.data(), "y");
}

}  // namespace
}  // namespace understudy::emulator
