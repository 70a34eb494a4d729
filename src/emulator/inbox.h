// Orders on their way to the tick.
#ifndef UNDERSTUDY_EMULATOR_INBOX_H_
#define UNDERSTUDY_EMULATOR_INBOX_H_

#include <chrono>
#include <cstddef>
#include <deque>
#include <future>
#include <mutex>
#include <optional>
#include <string>
#include <variant>

#include "emulator/order.h"

namespace understudy::emulator {

// "" when done, else why not.
using Answer = std::string;

// Bounded; the tick drains it without ever waiting for a lock. Must outlive those who wait for an
// answer.
class Inbox {
 public:
  using WallTime = std::chrono::steady_clock::time_point;

  static constexpr std::size_t kCapacity = 64;
  // Carried out by one drain, so that many orders do not make a long tick; *assumed*. A reset,
  // which takes about as long as a step, is the last of its drain.
  static constexpr std::size_t kMostAtOnce = 8;

  // Any thread but the tick's: hands an order in. The future holds the answer once the tick has
  // been there. An order the tick comes to later than `until` is not carried out, so that whoever
  // has given up on it may say so. nullopt: the inbox is full. May wait while the tick drains.
  std::optional<std::future<Answer>> Put(const Order& order, WallTime until);

  // The tick: calls Answer carry_out(const Order&) for waiting orders, in order of arrival; what is
  // left waits for the next. Returns at once, having done nothing, while another thread is at the
  // inbox; the next tick comes soon. carry_out must not throw or come back to the inbox.
  template <class CarryOut>
  void Drain(CarryOut&& carry_out) {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return;
    for (std::size_t done = 0; done < kMostAtOnce && !waiting_.empty(); ++done) {
      Entry& entry = waiting_.front();
      const bool late = std::chrono::steady_clock::now() > entry.until;
      if (!late && std::holds_alternative<ResetRobot>(entry.order)) done = kMostAtOnce;
      entry.answer.set_value(late ? Answer{"the order came too late"} : carry_out(entry.order));
      waiting_.pop_front();
    }
  }

 private:
  struct Entry {
    Order order;
    WallTime until;
    std::promise<Answer> answer;
  };

  std::mutex mutex_;
  std::deque<Entry> waiting_;
};

}  // namespace understudy::emulator

#endif  // UNDERSTUDY_EMULATOR_INBOX_H_
