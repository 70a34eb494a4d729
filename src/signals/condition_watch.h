// Conditions over the signals of a running world.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "emulator/script.h"
#include "emulator/told_event.h"
#include "judge/formula.h"
#include "perception/nearest_obstacle.h"
#include "physics/loose_bodies.h"
#include "signals/recent_arrivals.h"
#include "signals/signals.h"

namespace understudy::signals {

// What a script waits for.
struct Conditions {
  std::vector<Signal> signals{};
  std::vector<judge::Formula> formulas{};  // by number, over those signals; none looks ahead
};

// Follows the signals of the robots of a world. Everything that happened in a tick, and the
// truth at its end, is seen at the beginning of the next. Equal runs give equal answers bit for
// bit; allocates nothing after construction.
class ConditionWatch final : public emulator::ScriptConditions {
 public:
  // `world` must outlive it and has made no tick yet.
  ConditionWatch(signals::Conditions conditions, const emulator::World& world);

  void Look(const emulator::World& world, bool measure) override;
  bool Holds(std::size_t condition) const override;

 private:
  // What a signal takes from where.
  struct Slot {
    const emulator::EventRow* row = nullptr;        // of events of this kind,
    const emulator::RequestRow* request = nullptr;  // or told under the name of this request
    std::size_t field = 0;                          // of the row
    double word = 0;                                // kPrint
    std::size_t topic = 0;                          // of commands, by number
    const physics::LooseBody* object = nullptr;     // kTruth of an object
    std::uint64_t heard = 0;                        // its messages so far
    double last = 0;                                // s: the last one
    RecentArrivals recent;                          // kRate
  };

  // What conditions ask of a robot's truth.
  struct Measured {
    bool asked = false;
    std::vector<double> foot_force, hand_force, touch;
    std::vector<float> cells;
    TruthView truth;
    std::optional<perception::NearestObstacle> obstacles;  // where they are asked for
  };

  void Take(const emulator::Event& event);
  void Hear(const emulator::World& world);
  void Measure(const emulator::World& world);

  signals::Conditions conditions_;
  std::vector<Slot> slots_;     // by signal
  std::vector<double> values_;  // by signal; NaN: not known yet
  emulator::EventRing::Reader events_;
  std::vector<Measured> measured_;  // by robot
};

}  // namespace understudy::signals
