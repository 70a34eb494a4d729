#include "emulator/inbox.h"

#include <cerrno>
#include <system_error>
#include <utility>

#include <sys/eventfd.h>

namespace understudy::emulator {

void Reply::Give(Answer answer) {
  answer_.set_value(std::move(answer));
  ::eventfd_write(bell_, 1);  // fails only if the counter is full, and then it is readable anyway
}

Inbox::Inbox() : bell_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (!bell_.valid()) throw std::system_error(errno, std::generic_category(), "eventfd");
}

std::optional<std::future<Answer>> Inbox::Put(const Request& request, WallTime until) {
  const std::lock_guard lock(mutex_);
  if (waiting_.size() >= kCapacity) return std::nullopt;
  std::promise<Answer> answer;
  std::future<Answer> future = answer.get_future();
  waiting_.push_back({request, until, Reply(std::move(answer), bell_.get())});
  return future;
}

}  // namespace understudy::emulator
