// When which foot of a gait stands.
#pragma once

#include <array>
#include <cstddef>

namespace understudy::motion {

struct GaitTiming {
  double period = 0.5;                               // s
  double duty = 0.5;                                 // part of it that a foot stands, 0.5 or more
  double raise = 0.08;                               // m that a foot is lifted by
  std::array<double, 4> offsets = {0, 0.5, 0.5, 0};  // when FR FL RR RL touch down; all stand at 0
};

// The clock of a gait. Another period, duty and raise are taken over at 0 and half a period, when a
// pair of a trot touches down, so that no step changes while it is made; other offsets once all
// feet stand.
class GaitClock {
 public:
  // All feet stand for `wait` s, then the first lift: those that have stood longest at that part of
  // a stride.
  void Begin(const GaitTiming& gait, double wait, double phase = 0);

  // Goes on by dt [s]. With `halt` it stops as soon as all feet stand.
  void Advance(double dt, const GaitTiming& gait, bool halt);

  bool stands(std::size_t leg) const { return phase(leg) < gait_.duty; }
  bool halted() const { return halted_; }
  // Of a foot that stands: seconds since touchdown and until it lifts.
  double stood(std::size_t leg) const { return phase(leg) * gait_.period; }
  double stands_for(std::size_t leg) const { return (gait_.duty - phase(leg)) * gait_.period; }
  // Of one that swings: the part of its swing that is over, and seconds left.
  double swing_part(std::size_t leg) const { return (phase(leg) - gait_.duty) / (1 - gait_.duty); }
  double swing_left(std::size_t leg) const { return (1 - phase(leg)) * gait_.period; }
  double raise() const { return gait_.raise; }
  double stance_time() const { return gait_.duty * gait_.period; }       // s
  double swing_time() const { return (1 - gait_.duty) * gait_.period; }  // s

 private:
  double phase(std::size_t leg) const;  // 0 at touchdown, to 1
  bool all_stand() const { return stands(0) && stands(1) && stands(2) && stands(3); }

  GaitTiming gait_;
  double phase_ = 0;  // of what has no offset
  double wait_ = 0;   // s
  bool halted_ = true;
};

}  // namespace understudy::motion
