// When which foot of a trot stands.
#pragma once

#include <cstddef>

namespace understudy::motion {

struct Gait {
  double period = 0.5;  // s
  double duty = 0.5;    // part of it that a foot stands, 0.5 or more
};

// The clock of a trot: FR and RL step together, FL and RR half a period later. A gait is taken over
// when a pair touches down, so that no step changes while it is made.
class GaitClock {
 public:
  // All feet stand for `wait` s, then FL and RR lift.
  void Begin(const Gait& gait, double wait);

  // Goes on by dt [s]. With `halt` it stops as soon as all feet stand.
  void Advance(double dt, const Gait& gait, bool halt);

  bool stands(std::size_t leg) const { return phase(leg) < gait_.duty; }
  bool halted() const { return halted_; }
  // Of a foot that stands: seconds since touchdown and until it lifts.
  double stood(std::size_t leg) const { return phase(leg) * gait_.period; }
  double stands_for(std::size_t leg) const { return (gait_.duty - phase(leg)) * gait_.period; }
  // Of one that swings: the part of its swing that is over, and seconds left.
  double swing_part(std::size_t leg) const { return (phase(leg) - gait_.duty) / (1 - gait_.duty); }
  double swing_left(std::size_t leg) const { return (1 - phase(leg)) * gait_.period; }
  double stance_time() const { return gait_.duty * gait_.period; }       // s
  double swing_time() const { return (1 - gait_.duty) * gait_.period; }  // s

 private:
  double phase(std::size_t leg) const;  // 0 at touchdown, to 1

  Gait gait_;
  double phase_ = 0;  // of FR and RL
  double wait_ = 0;   // s
  bool halted_ = true;
};

}  // namespace understudy::motion
