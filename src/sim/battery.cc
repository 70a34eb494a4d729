#include "sim/battery.h"

#include <algorithm>

namespace understudy {

Battery::Battery(const BatterySpec& spec) : spec_(spec) {
  reading_.soc = spec.start_soc;
  reading_.current = -spec.idle_a;
  reading_.voltage = OpenVoltage() + spec.internal_ohm * reading_.current;
}

void Battery::Step(std::span<const double> tau, std::span<const double> dq, double dt) {
  double work = 0;
  double square = 0;
  for (std::size_t i = 0; i < tau.size(); ++i) {
    work += tau[i] * dq[i];
    square += tau[i] * tau[i];
  }
  const double power = std::max(work, 0.0) + spec_.watt_per_nm2 * square;
  const double drawn = spec_.idle_a + power / reading_.voltage;
  reading_.current = -drawn;
  reading_.soc = std::max(0.0, reading_.soc - drawn * dt / (3600 * spec_.capacity_ah));
  reading_.voltage = OpenVoltage() - spec_.internal_ohm * drawn;
}

double Battery::OpenVoltage() const {
  const double cell = spec_.cell_empty_v + reading_.soc * (spec_.cell_full_v - spec_.cell_empty_v);
  return spec_.cells * cell;
}

}  // namespace understudy
