// Passes requests to the tick and its answers back.
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

// Gives the answer to one request. Must not outlive its inbox.
class Reply {
 public:
  Reply(std::promise<Answer> answer, int bell) : answer_(std::move(answer)), bell_(bell) {}

  // Gives the answer and wakes the waiting thread. Call it once. Never blocks.
  void Give(Answer answer);

 private:
  std::promise<Answer> answer_;
  int bell_;
};

// A bounded queue that the tick drains without waiting for a lock. Must outlive threads that wait
// for an answer.
class Inbox {
 public:
  using WallTime = std::chrono::steady_clock::time_point;

  static constexpr std::size_t kCapacity = 64;
  // The most requests per drain, which bounds the length of a tick; *assumed*. A reset, which takes
  // about as long as a step, ends the drain.
  static constexpr std::size_t kMostAtOnce = 8;

  // Throws std::system_error if no file descriptor is available.
  Inbox();

  // Adds a request, from any thread but the tick's. The future gets the tick's answer. A request
  // that the tick reaches later than `until` is dropped, so a caller that has given up can rely on
  // that. Returns nullopt if the inbox is full. May wait while the tick drains.
  std::optional<std::future<Answer>> Put(const Request& request, WallTime until);

  // An eventfd that becomes readable when answers were given.
  int bell() const { return bell_.get(); }

  // Called by the tick at wall time `now`: calls std::optional<Answer> carry_out(Request*, Reply*)
  // for waiting requests in order of arrival, at most kMostAtOnce. carry_out returns nullopt if it
  // keeps the reply to answer later; it must not throw or call the inbox. While another thread uses
  // the inbox, Drain does nothing and the next tick tries again.
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
