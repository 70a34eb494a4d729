// The newest refused commands.
#ifndef UNDERSTUDY_EMULATOR_REFUSAL_LOG_H_
#define UNDERSTUDY_EMULATOR_REFUSAL_LOG_H_

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "emulator/frame.h"

namespace understudy::emulator {

// Of one thread. Allocates nothing. Refusals of the same topic for the same reason that follow each
// other are one entry; the oldest entries go first.
class RefusalLog {
 public:
  // kNone is none.
  void Add(std::size_t topic, robot::Refusal reason, double t) {
    if (reason == robot::Refusal::kNone) return;
    if (count_ > 0) {
      RefusedCommands& newest = entries_[(count_ - 1) % entries_.size()];
      if (newest.topic == topic && newest.reason == reason) {
        newest.last = t;
        ++newest.count;
        return;
      }
    }
    entries_[count_++ % entries_.size()] = {
        .first = t, .last = t, .topic = topic, .reason = reason, .count = 1};
  }

  // Oldest first. `to` has room for kMostFrameRefusals.
  void CopyTo(std::vector<RefusedCommands>* to) const {
    to->clear();
    const std::size_t kept = std::min(count_, entries_.size());
    for (std::size_t i = count_ - kept; i < count_; ++i) {
      to->push_back(entries_[i % entries_.size()]);
    }
  }

 private:
  std::array<RefusedCommands, kMostFrameRefusals> entries_{};
  std::size_t count_ = 0;  // since start
};

}  // namespace understudy::emulator

#endif  // UNDERSTUDY_EMULATOR_REFUSAL_LOG_H_
