#include "tests/support/fake_port.h"

namespace understudy::test {

bool FakePort::Take(std::size_t topic, robot::RobotCommand* command, robot::Refusal* form) {
  Topic& from = topics_[topic];
  if (!from.waiting.empty()) {
    *command = from.waiting.front().command;
    *form = from.waiting.front().form;
    from.waiting.pop_front();
    return true;
  }
  from.steady_taken = from.steady.has_value() && !from.steady_taken;
  if (!from.steady_taken) return false;
  *command = *from.steady;
  *form = robot::Refusal::kNone;
  return true;
}

void FakePort::Publish(const robot::RobotState& state, std::int64_t,
                       std::span<const robot::LinkEffects> links) {
  if (!links.empty()) link_ = links.front();
  if (link_.drops) return;
  ++published_;
  if (keep_all_ || samples_.empty()) {
    samples_.push_back({state});
  } else {
    samples_.back().state = state;
  }
}

}  // namespace understudy::test
