#include "robot/battery.h"

#include <algorithm>
#include <cmath>

namespace understudy::robot {

Battery::Battery(const BatterySpec& spec) : spec_(spec) {
  reading_.soc = spec.start_soc;
  Load(0);
}

void Battery::Step(std::span<const double> tau, std::span<const double> dq, double dt) {
  double work = 0;
  double square = 0;
  for (std::size_t i = 0; i < tau.size(); ++i) {
    work += tau[i] * dq[i];
    square += tau[i] * tau[i];
  }
  Load(std::max(work, 0.0) + spec_.watt_per_nm2 * square);
  reading_.soc = std::max(0.0, reading_.soc + reading_.current * dt / (3600 * spec_.capacity_ah));
}

// V of  V = V0 - R · P / V  with V0 the voltage of the idle pack.
void Battery::Load(double power) {
  const double cell = spec_.cell_empty_v + reading_.soc * (spec_.cell_full_v - spec_.cell_empty_v);
  const double idle_v = spec_.cells * cell - spec_.internal_ohm * spec_.idle_a;
  const double most = idle_v * idle_v / 4;  // of R · P
  const double loss = std::min(spec_.internal_ohm * power, most);
  reading_.voltage = idle_v / 2 + std::sqrt(most - loss);
  const double given = loss < most ? power : most / spec_.internal_ohm;
  reading_.current = -(spec_.idle_a + given / reading_.voltage);
}

}  // namespace understudy::robot
