// Judges the commands of one topic and counts what became of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "robot/refusal.h"

namespace understudy::authority {

// Of one topic, since start.
struct GateCounts {
  std::uint64_t accepted = 0;
  std::array<std::uint64_t, robot::kRefusals> refused{};  // by Refusal; kNone stays 0
  std::uint64_t timeouts = 0;                             // times that commands stopped
};

// Strict, it refuses what is wrong in form (crc, head, mode_machine, mode_pr, motor mode). Lenient,
// it lets that pass and counts it all the same, but not what could not be read: a command for
// another number of motors, bytes of another type.
class Intake {
 public:
  // Taken of a topic in one tick, so that many commands do not make a long one; *assumed*.
  static constexpr int kMostAtOnce = 8;

  explicit Intake(bool lenient) : lenient_(lenient) {}

  // Returns kNone when the command is taken, else why not. `form` is what the port found wrong with
  // it; robot::Refusal offer() hands it to whoever is to follow it, and refuses in its turn.
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

  // `timeouts` is 0: gates know it.
  const GateCounts& counts() const { return counts_; }

 private:
  std::uint64_t& refused(robot::Refusal refusal) {
    return counts_.refused[static_cast<std::size_t>(refusal)];
  }

  bool lenient_;
  GateCounts counts_;
};

}  // namespace understudy::authority
