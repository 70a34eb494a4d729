#include "robot/battery.h"

#include <algorithm>
#include <cmath>

namespace understudy::robot {

Battery::Battery(const BatterySpec& spec) : spec_(spec) {
  reading_.soc = spec.start_soc;
  Load(0, spec.internal_ohm);
}

void Battery::Step(std::span<const double> tau, std::span<const double> dq, double dt,
                   const BatteryEffects& fault) {
  double work = 0;
  double square = 0;
  for (std::size_t i = 0; i < tau.size(); ++i) {
    work += tau[i] * dq[i];
    square += tau[i] * tau[i];
  }
  Load(std::max(work, 0.0) + spec_.watt_per_nm2 * square, fault.resistance * spec_.internal_ohm);
  const double charge = reading_.soc + reading_.current * dt / (3600 * spec_.capacity_ah);
  reading_.soc = std::clamp(charge, 0.0, fault.most_charge);
}

// V of  V = V0 - R · P / V  with V0 the voltage of the idle pack.
void Battery::Load(double power, double internal_ohm) {
  const double cell = spec_.cell_empty_v + reading_.soc * (spec_.cell_full_v - spec_.cell_empty_v);
  const double idle_v = spec_.cells * cell - internal_ohm * spec_.idle_a;
  const double most = idle_v * idle_v / 4;  // of R · P
  const double loss = std::min(internal_ohm * power, most);
  reading_.voltage = idle_v / 2 + std::sqrt(most - loss);
  const double given = loss < most ? power : most / internal_ohm;
  reading_.current = -(spec_.idle_a + given / reading_.voltage);
}

}  // namespace understudy::robot
