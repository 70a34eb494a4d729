// The commands of one topic as they come over its link.
#pragma once

#include <cstdint>
#include <utility>

#include "robot/fault.h"
#include "robot/refusal.h"
#include "robot/robot_values.h"
#include "wire/link.h"

namespace understudy::wire {

class Inlet {
 public:
  explicit Inlet(bool has_crc) : link_(has_crc, kLongestHeld) {}

  // Takes the next command that has arrived at t [s], as RobotPort::Take. `faults` are those of the
  // link now; take(RobotCommand*, Refusal*) takes the next command that was sent.
  template <class TakeSent>
  bool Take(const robot::LinkEffects& faults, double t, TakeSent&& take,
            robot::RobotCommand* command, robot::Refusal* form) {
    for (int sent = 0; sent < kMostSent; ++sent) {
      if (const Sent* const arrived = link_.Arrived(t)) {
        *form = arrived->form;
        if (!robot::IsUnreadable(*form)) *command = arrived->command;
        ++heard_;
        return true;
      }
      if (!take(command, form)) return false;
      if (link_.IsClear(faults)) {
        ++heard_;
        return true;
      }
      const bool sends = link_.Send(faults, t, [&](Sent* copy, bool damaged) {
        // What was wrong before stays the reason, so that what cannot be read is never taken.
        const bool now_wrong = damaged && *form == robot::Refusal::kNone;
        copy->form = now_wrong ? robot::Refusal::kCrc : *form;
        if (!robot::IsUnreadable(*form)) copy->command = *command;
      });
      if (!sends) ++lost_;
    }
    return false;
  }

  // Returns how many commands arrived so far.
  std::uint64_t heard() const { return heard_; }
  // Returns how many were lost since the last call, because too many were late.
  std::uint64_t TakeLost() { return std::exchange(lost_, 0); }
  // Drops all that is under way.
  void Clear() {
    link_.Clear();
    lost_ = 0;
  }

 private:
  // s after which a command that was overtaken is lost: an old one would make the robot jump.
  // *assumed*
  static constexpr double kLongestHeld = 0.1;
  // Commands that one call sends over the link, which bounds its time.
  static constexpr int kMostSent = 16;

  struct Sent {
    robot::RobotCommand command;
    robot::Refusal form = robot::Refusal::kNone;
  };

  Link<Sent> link_;
  std::uint64_t heard_ = 0;
  std::uint64_t lost_ = 0;
};

}  // namespace understudy::wire
