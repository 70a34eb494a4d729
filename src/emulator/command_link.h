// The way of one topic's commands from the port to the router, with the faults of that topic.
#pragma once

#include <cstdint>
#include <utility>

#include "base/late_queue.h"
#include "robot/fault.h"
#include "robot/refusal.h"
#include "robot/robot_values.h"

namespace understudy::emulator {

// Commands may get lost on it, or come damaged, late, twice or after the next one. Times are
// simulated [s] and never go back. Whom it hands them over to has Offer(command, form), called for
// each that comes, and Done(), called after those that came of one.
class CommandLink {
 public:
  // `like`: a command with as many motors. Those of hands have no crc.
  CommandLink(bool has_crc, const robot::RobotCommand& like)
      : has_crc_(has_crc), held_{.command = like} {}

  // Sends a command at t. Returns false if there is no room for one more that is late.
  template <class To>
  bool Send(const robot::RobotCommand& command, robot::Refusal form, const robot::LinkEffects& link,
            double t, const To& to) {
    if (link.drops || (link.damages && !has_crc_)) return true;
    if (link.damages) form = robot::Refusal::kCrc;
    if (link.delay <= 0 && late_.empty()) {
      Arrive(command, form, link, t, to);
      return true;
    }
    Late* const late = late_.Push(t + link.delay);
    if (late == nullptr) return false;
    late->command = command;
    late->form = form;
    return true;
  }

  // Hands over the first that was late and has come; returns false if there is none.
  template <class To>
  bool TakeLate(const robot::LinkEffects& link, double t, const To& to) {
    const Late* const late = late_.Due(t);
    if (late == nullptr) return false;
    Arrive(late->command, late->form, link, t, to);
    late_.Pop();
    return true;
  }

  bool any_late() const { return !late_.empty(); }
  // Returns how many came so far, taken or not.
  std::uint64_t heard() const { return heard_; }

 private:
  // s after which a command that was overtaken is lost: an old one would make the robot jump.
  // *assumed*
  static constexpr double kLongestHeld = 0.1;

  struct Late {
    robot::RobotCommand command;
    robot::Refusal form = robot::Refusal::kNone;
  };
  struct Held {  // goes after the next one
    robot::RobotCommand command;
    robot::Refusal form = robot::Refusal::kNone;
    bool there = false;
    double since = 0;  // s
  };

  template <class To>
  void Arrive(const robot::RobotCommand& command, robot::Refusal form,
              const robot::LinkEffects& link, double t, const To& to) {
    ++heard_;
    if (link.reorders && !held_.there) {
      held_ = {command, form, true, t};
      return;
    }
    for (int times = link.doubles ? 2 : 1; times > 0; --times) to.Offer(command, form);
    if (std::exchange(held_.there, false) && t - held_.since < kLongestHeld) {
      to.Offer(held_.command, held_.form);
    }
    to.Done();
  }

  bool has_crc_;
  Held held_;
  LateQueue<Late> late_;
  std::uint64_t heard_ = 0;
};

}  // namespace understudy::emulator
