// Checks the form of the commands of one topic and counts taken and refused ones.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "robot/refusal.h"

namespace understudy::authority {

// Counts of one topic since the start.
struct GateCounts {
  std::uint64_t accepted = 0;
  std::array<std::uint64_t, robot::kRefusals> refused{};  // by Refusal; kNone stays 0
  std::uint64_t timeouts = 0;                             // how often commands stopped
};

// A strict intake refuses faults of form (crc, head, mode_machine, mode_pr, motor mode). A lenient
// one only counts them, but still refuses what cannot be read: a wrong number of motors, bytes of
// another type.
class Intake {
 public:
  // The most commands per tick, of a topic and of all topics together, which bounds the length of a
  // tick; *assumed*. By number, not by time, so that equal commands at equal steps have equal
  // effects: they are bounded in length, and each takes about as long.
  static constexpr int kMostAtOnce = 8;
  static constexpr int kMostInATick = 16;

  explicit Intake(bool lenient) : lenient_(lenient) {}

  void SetLenient(bool lenient) { lenient_ = lenient; }

  // Returns kNone if the command is taken, else the reason. `form` is the fault of form that the
  // port found; robot::Refusal offer() passes the command on and may refuse it too.
  template <class Offer>
  robot::Refusal Judge(robot::Refusal form, Offer&& offer) {
    if (form != robot::Refusal::kNone) ++refused(form);
    if (form != robot::Refusal::kNone && (!lenient_ || robot::IsUnreadable(form))) {
      return form;
    }
    const robot::Refusal refusal = std::forward<Offer>(offer)();
    ++(refusal == robot::Refusal::kNone ? counts_.accepted : refused(refusal));
    return refusal;
  }

  // Counts what never came to be judged.
  void Count(robot::Refusal refusal, std::uint64_t times) { refused(refusal) += times; }

  // `timeouts` is 0, since gates count them.
  const GateCounts& counts() const { return counts_; }

 private:
  std::uint64_t& refused(robot::Refusal refusal) {
    return counts_.refused[static_cast<std::size_t>(refusal)];
  }

  bool lenient_;
  GateCounts counts_;
};

}  // namespace understudy::authority
