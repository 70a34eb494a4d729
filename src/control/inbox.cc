#include "control/inbox.h"

#include <utility>

namespace understudy {

Answer Inbox::Submit(Order order, std::chrono::milliseconds patience) {
  std::future<Answer> answer;
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() >= kCapacity) return "the robot is busy: too many orders wait";
    waiting_.push_back({order, {}});
    answer = waiting_.back().answer.get_future();
  }
  if (answer.wait_for(patience) != std::future_status::ready) {
    return "the robot did not answer in time";
  }
  return answer.get();
}

}  // namespace understudy
