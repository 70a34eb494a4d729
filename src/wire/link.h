// A link over which messages get lost, or come damaged, late, twice or after the next one.
#pragma once

#include <limits>
#include <utility>

#include "base/late_queue.h"
#include "robot/fault.h"

namespace understudy::wire {

// The one law of faulty links, for commands to a robot and for what it publishes. A message has the
// faults of the moment at which it is sent. Times are simulated [s] and never go back. Messages are
// kept in places that are used again, so that it stops to allocate once it has been as full as it
// gets.
template <class Message>
class Link {
 public:
  // A damaged message without a crc is lost. So is a reordered one if the message after it comes
  // `longest_held` [s] later or more.
  explicit Link(bool has_crc, double longest_held = std::numeric_limits<double>::infinity())
      : has_crc_(has_crc), longest_held_(longest_held) {}

  // Returns whether a message sent now arrives at once and unchanged: it need not be sent then.
  bool IsClear(const robot::LinkEffects& faults) const {
    return !holds_ && late_.empty() && faults.delay <= 0 && !faults.drops && !faults.doubles &&
           !faults.damages && !faults.reorders;
  }

  // Sends a message at t; fill(Message*, bool damaged) makes it unless it is lost. Take all that
  // has arrived before. Returns false if it is lost because too many are late.
  template <class Fill>
  bool Send(const robot::LinkEffects& faults, double t, Fill&& fill) {
    if (faults.drops || (faults.damages && !has_crc_)) return true;
    if (faults.delay <= 0 && late_.empty()) {
      std::forward<Fill>(fill)(&here_, faults.damages);
      Arrive(faults, t);
      return true;
    }
    Late* const late = late_.Push(t + faults.delay);
    if (late == nullptr) return false;
    std::forward<Fill>(fill)(&late->message, faults.damages);
    late->faults = faults;
    return true;
  }

  // Returns the next message that has arrived at t, null if there is none. It is valid until the
  // next call.
  const Message* Arrived(double t) {
    while (left_ == 0 && !frees_) {
      Late* const late = late_.Due(t);
      if (late == nullptr) return nullptr;
      std::swap(here_, late->message);
      const robot::LinkEffects faults = late->faults;
      late_.Pop();
      Arrive(faults, t);
    }
    if (left_ == 0) {
      frees_ = false;
      return &held_;
    }
    --left_;
    return &here_;
  }

  bool any_late() const { return !late_.empty(); }

  // Drops all that is under way.
  void Clear() {
    late_.Clear();
    left_ = 0;
    holds_ = frees_ = false;
  }

 private:
  struct Late {
    Message message{};
    robot::LinkEffects faults;
  };

  // What to do with the message in here_.
  void Arrive(const robot::LinkEffects& faults, double t) {
    if (faults.reorders && !holds_) {
      std::swap(here_, held_);
      holds_ = true;
      held_since_ = t;
      return;
    }
    left_ = faults.doubles ? 2 : 1;
    frees_ = std::exchange(holds_, false) && t - held_since_ < longest_held_;
  }

  bool has_crc_;
  double longest_held_;
  LateQueue<Late> late_;
  Message here_{}, held_{};
  double held_since_ = 0;
  int left_ = 0;        // how often here_ still arrives
  bool holds_ = false;  // held_ waits for the next message
  bool frees_ = false;  // held_ arrives after here_
};

}  // namespace understudy::wire
