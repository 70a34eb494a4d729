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

std::optional<Inbox::Asked> Inbox::Put(const Request& request) {
  const std::lock_guard lock(mutex_);
  if (waiting_.size() >= kCapacity) return std::nullopt;
  std::promise<Answer> answer;
  std::future<Answer> future = answer.get_future();
  waiting_.push_back({++put_, request, Reply(std::move(answer), bell_.get())});
  return Asked{.number = put_, .answer = std::move(future)};
}

bool Inbox::Withdraw(std::uint64_t number) {
  const std::lock_guard lock(mutex_);
  return std::erase_if(waiting_, [&](const Entry& one) { return one.number == number; }) > 0;
}

std::optional<Inbox::Entry> Inbox::Take() {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock || waiting_.empty()) return std::nullopt;
  std::optional<Entry> entry = std::move(waiting_.front());
  waiting_.pop_front();
  return entry;
}

}  // namespace understudy::emulator
