// Excites a robot over its own topics, the simulated one or a real one on a stand.
#pragma once

#include <functional>
#include <string>

#include "identify/excitation.h"
#include "physics/bench.h"

namespace understudy::identify {

struct ExciteSettings {
  std::string interface = "lo";
  int domain = 0;
  ExcitationSpec excitation{};
  bool on_a_real_robot = false;
};

// How it ended.
enum class ExciteEnd { kDone, kStopped, kInTheWay };

// Commands the joints (Excitation) at 500 Hz by the wall clock until the end, a signal, or until a
// joint is further than 0.6 rad from where it is to be; then too damping comes softly. Before that
// it makes sure that a robot is there; that it is one of this program, unless `on_a_real_robot`
// (NeighbourError); and that nobody else writes rt/lowcmd, that no motion service has the motors as
// far as motion_switcher tells, and that its feet carry less than a third of its weight as far as
// they are measured (ControlError, with what to do). Throws BusError if no state comes, also later.
// `told` gets lines for people; `progress` ten times a second how much of the excitation is done,
// and how long all of it takes [s].
ExciteEnd Excite(const robot::RobotSpec& spec, const physics::Bench& bench,
                 const ExciteSettings& settings,
                 const std::function<void(const std::string&)>& told,
                 const std::function<void(double done, double whole)>& progress);

}  // namespace understudy::identify
