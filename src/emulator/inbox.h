// Requests on their way to the tick, and its answers on their way back.
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <future>
#include <mutex>
#include <optional>

#include "base/unique_fd.h"
#include "emulator/request.h"

namespace understudy::emulator {

// Where the answer to one request goes. Must not outlive the inbox that it came from.
class Reply {
 public:
  Reply(std::promise<Answer> answer, int bell) : answer_(std::move(answer)), bell_(bell) {}

  // Once. Wakes who waits; never blocks.
  void Give(Answer answer);

 private:
  std::promise<Answer> answer_;
  int bell_;
};

// Bounded; the tick drains it without ever waiting for a lock. Must outlive those who wait for an
// answer.
class Inbox {
 public:
  using WallTime = std::chrono::steady_clock::time_point;

  static constexpr std::size_t kCapacity = 64;
  // Carried out by one drain, so that many requests do not make a long tick; *assumed*. A reset,
  // which takes about as long as a step, is the last of its drain.
  static constexpr std::size_t kMostAtOnce = 8;

  // Throws std::system_error where the system has no descriptor left.
  Inbox();

  // Any thread but the tick's: hands a request in. The future holds the answer once the tick has
  // been there. Requests that the tick comes to later than `until` are dropped, so that a caller
  // that gave up can rely on it. nullopt: the inbox is full. May wait while the tick drains.
  std::optional<std::future<Answer>> Put(const Request& request, WallTime until);

  // An eventfd that becomes readable when answers were given.
  int bell() const { return bell_.get(); }

  // The tick, at wall time `now` since the epoch of WallTime: calls std::optional<Answer>
  // carry_out(Request*, Reply*) for waiting requests, in order of arrival; what is left waits for
  // the next. nullopt: it has taken the reply and will give the answer later. Returns at once,
  // having done nothing, while another thread is at the inbox; the next tick comes soon. carry_out
  // must not throw or come back to the inbox.
  template <class CarryOut>
  void Drain(WallTime::duration now, CarryOut&& carry_out) {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return;
    for (std::size_t done = 0; done < kMostAtOnce && !waiting_.empty(); ++done) {
      Entry& entry = waiting_.front();
      const bool late = now > entry.until.time_since_epoch();
      if (!late && entry.request.row->name == "reset") done = kMostAtOnce;
      std::optional<Answer> answer = late ? Answer{Error{"the request came too late"}}
                                          : carry_out(&entry.request, &entry.reply);
      if (answer) entry.reply.Give(*std::move(answer));
      waiting_.pop_front();
    }
  }

 private:
  struct Entry {
    Request request;
    WallTime until;
    Reply reply;
  };

  UniqueFd bell_;
  std::mutex mutex_;
  std::deque<Entry> waiting_;
};

}  // namespace understudy::emulator
