// Passes requests to the tick and its answers back.
#pragma once

#include <cstddef>
#include <cstdint>
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
  // A request in the inbox.
  struct Asked {
    std::uint64_t number;
    std::future<Answer> answer;
  };

  static constexpr std::size_t kCapacity = 64;
  // The most requests per drain, which bounds the length of a tick; *assumed*. A reset, which takes
  // about as long as a step, ends the drain.
  static constexpr std::size_t kMostAtOnce = 8;

  // Throws std::system_error if no file descriptor is available.
  Inbox();

  // Adds a request, from any thread but the tick's. The future gets the tick's answer. Returns
  // nullopt if the inbox is full.
  std::optional<Asked> Put(const Request& request);

  // Takes a request back, which then is never carried out. Returns false if the tick was faster:
  // then its answer is there or comes.
  bool Withdraw(std::uint64_t number);

  // An eventfd that becomes readable when answers were given.
  int bell() const { return bell_.get(); }

  // Called by the tick: calls std::optional<Answer> carry_out(Request*, Reply*) for waiting
  // requests in order of arrival, at most kMostAtOnce. carry_out returns nullopt if it keeps the
  // reply to answer later; it must not throw. Other threads do not wait for it. While one of them
  // uses the inbox, Drain returns and the next tick tries again.
  template <class CarryOut>
  void Drain(CarryOut&& carry_out) {
    for (std::size_t done = 0; done < kMostAtOnce; ++done) {
      std::optional<Entry> entry = Take();
      if (!entry) return;
      if (entry->request.row->name == "reset") done = kMostAtOnce;
      std::optional<Answer> answer = carry_out(&entry->request, &entry->reply);
      if (answer) entry->reply.Give(*std::move(answer));
    }
  }

 private:
  struct Entry {
    std::uint64_t number;
    Request request;
    Reply reply;
  };

  std::optional<Entry> Take();

  UniqueFd bell_;
  std::mutex mutex_;
  std::uint64_t put_ = 0;  // requests so far
  std::deque<Entry> waiting_;
};

}  // namespace understudy::emulator
