// What the outside asks of a running robot.
#ifndef UNDERSTUDY_CONTROL_INBOX_H_
#define UNDERSTUDY_CONTROL_INBOX_H_

#include <chrono>
#include <deque>
#include <future>
#include <mutex>
#include <string>
#include <variant>

namespace understudy {

struct LowerCrane {
  double by = 0;  // m; negative raises
};
struct AttachCrane {};  // from straight above, where the robot is
struct ReleaseCrane {};
struct ClampBase {
  bool on = true;
};
struct ResetRobot {};  // back to the start pose, command gate included

using Order = std::variant<LowerCrane, AttachCrane, ReleaseCrane, ClampBase, ResetRobot>;

// "" when done, else why not.
using Answer = std::string;

// Bounded; the tick drains it without ever waiting for a lock.
class Inbox {
 public:
  static constexpr std::size_t kCapacity = 64;

  // Any thread but the tick's: hands an order in and waits for its answer. After `patience` without
  // one, or when the inbox is full, says so; a late order may still be carried out.
  Answer Submit(Order order, std::chrono::milliseconds patience);

  // The tick: calls Answer carry_out(const Order&) for each waiting order, in order of arrival.
  template <class CarryOut>
  void Drain(CarryOut&& carry_out) {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return;
    while (!waiting_.empty()) {
      waiting_.front().answer.set_value(carry_out(waiting_.front().order));
      waiting_.pop_front();
    }
  }

 private:
  struct Entry {
    Order order;
    std::promise<Answer> answer;
  };

  std::mutex mutex_;
  std::deque<Entry> waiting_;
};

}  // namespace understudy

#endif  // UNDERSTUDY_CONTROL_INBOX_H_
