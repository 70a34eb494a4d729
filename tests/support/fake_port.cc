#include "tests/support/fake_port.h"

namespace understudy::test {

bool FakePort::Take(std::size_t topic, robot::RobotCommand* command, robot::Refusal* form) {
  Topic& from = topics_[topic];
  const auto take = [&from](robot::RobotCommand* sent, robot::Refusal* its_form) {
    if (!from.waiting.empty()) {
      *sent = from.waiting.front().command;
      *its_form = from.waiting.front().form;
      from.waiting.pop_front();
      return true;
    }
    from.steady_taken = from.steady.has_value() && !from.steady_taken;
    if (!from.steady_taken) return false;
    *sent = *from.steady;
    *its_form = robot::Refusal::kNone;
    return true;
  };
  return from.inlet.Take(faults_.commands.empty() ? robot::LinkEffects{} : faults_.commands[topic],
                         now_, take, command, form);
}

void FakePort::Clear() {
  for (Topic& topic : topics_) {
    topic.waiting.clear();
    topic.lost = 0;
    topic.inlet.Clear();
  }
}

void FakePort::Publish(const robot::RobotState& state, std::int64_t) {
  link_ = faults_.publications.empty() ? robot::LinkEffects{} : faults_.publications.front();
  if (link_.drops) return;
  ++published_;
  if (keep_all_ || samples_.empty()) {
    samples_.push_back({state});
  } else {
    samples_.back().state = state;
  }
}

}  // namespace understudy::test
