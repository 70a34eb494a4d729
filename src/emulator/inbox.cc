#include "emulator/inbox.h"

namespace understudy::emulator {

std::optional<std::future<Answer>> Inbox::Put(const Order& order, WallTime until) {
  const std::lock_guard lock(mutex_);
  if (waiting_.size() >= kCapacity) return std::nullopt;
  return waiting_.emplace_back(Entry{order, until, {}}).answer.get_future();
}

}  // namespace understudy::emulator
