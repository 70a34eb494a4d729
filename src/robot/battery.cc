#include "robot/battery.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace understudy::robot {
namespace {

// W; more is of physics that diverge, and the pack is to be what it was after that. *Assumed*, far
// beyond what any robot takes.
constexpr double kMostPower = 1e9;

// How much lower the end cells are: measured, on two Go2 (docs/dev/sources.md#go2-captures); on
// other robots *assumed*.
constexpr std::array<double, 2> kEndCells = {0.003, 0.013};  // V

// A number from 0 to 1, equal with every standard library.
double Draw(std::mt19937_64* random) { return static_cast<double>((*random)() >> 11U) * 0x1p-53; }

// Returns by how much each of `cells` is over their mean.
std::array<double, kMostCells> CellsOff(int cells, double spread, int seed) {
  std::array<double, kMostCells> off{};
  if (cells <= 0 || cells > static_cast<int>(kMostCells) || spread <= 0) return off;
  const auto count = static_cast<std::size_t>(cells);
  std::mt19937_64 random(static_cast<std::uint64_t>(seed) ^ 0xCE11U);
  for (std::size_t i = 0; i < count; ++i) {
    // Four even numbers, whose sum has a deviation of 1 / sqrt(3).
    const double sum = Draw(&random) + Draw(&random) + Draw(&random) + Draw(&random);
    off[i] = spread * std::sqrt(3.0) * (sum - 2);
  }
  for (const std::size_t end : {std::size_t{0}, count - 1}) {
    off[end] -= kEndCells[0] + (kEndCells[1] - kEndCells[0]) * Draw(&random);
  }
  const double mean = std::accumulate(off.begin(), off.begin() + cells, 0.0) / cells;
  for (std::size_t i = 0; i < count; ++i) off[i] -= mean;
  return off;
}

}  // namespace

Battery::Battery(const BatterySpec& spec, double ambient_c, int seed)
    : spec_(spec), ambient_c_(ambient_c), resistance_(spec.internal_ohm) {
  reading_.soc = spec.start_soc;
  reading_.temperature_c = ambient_c;
  reading_.cell_off_v = CellsOff(spec.cells, spec.cell_spread, seed);
  weakest_v_ = *std::ranges::min_element(reading_.cell_off_v);
  Load(0);
  bus_v_ = reading_.voltage;
  mean_a_ = -reading_.current;
  mean_cell_v_ = reading_.voltage / spec_.cells + weakest_v_;
}

void Battery::Step(double power, double dt, const BatteryEffects& fault) {
  if (!(std::abs(power) < kMostPower)) power = 0;
  resistance_ = fault.resistance * spec_.internal_ohm;
  Load(power);
  bus_v_ += (reading_.voltage - bus_v_) * dt / (kLag + dt);
  const double charge = reading_.soc + reading_.current * dt / (3600 * spec_.capacity_ah);
  reading_.soc = std::clamp(charge, 0.0, fault.most_charge);
  const double loss = reading_.current * reading_.current * resistance_;
  const double warm_c = ambient_c_ + spec_.rise_per_w_c * loss;
  reading_.temperature_c += (warm_c - reading_.temperature_c) * dt / (spec_.time_constant + dt);
  if (cut_off_ == CutOff::kNone) Protect(dt);
}

void Battery::SwitchOff() {
  reading_.voltage = OpenVoltage();
  reading_.current = 0;
}

void Battery::Restart() {
  if (cut_off_ == CutOff::kNone || reading_.soc <= 0) return;
  cut_off_ = CutOff::kNone;
  Load(0);
  bus_v_ = reading_.voltage;
  mean_a_ = -reading_.current;
  mean_cell_v_ = reading_.voltage / spec_.cells + weakest_v_;
}

MotorSupply Battery::supply() const {
  if (cut_off_ != CutOff::kNone) return {.voltage = 0, .most_power = 0, .on = false};
  const double idle_v = OpenVoltage() - resistance_ * spec_.idle_a;
  double most_a = spec_.most_a > 0 ? std::max(0.0, spec_.most_a - spec_.idle_a)
                                   : std::numeric_limits<double>::infinity();
  if (resistance_ > 0) most_a = std::min(most_a, idle_v / (2 * resistance_));
  const double drop = most_a < std::numeric_limits<double>::infinity() ? resistance_ * most_a : 0;
  return {.voltage = bus_v_, .most_power = (idle_v - drop) * most_a, .on = true};
}

double Battery::OpenVoltage() const {
  const double steps = static_cast<double>(spec_.cell_v.size() - 1);
  const double place = std::clamp(reading_.soc, 0.0, 1.0) * steps;
  const auto below = static_cast<std::size_t>(std::min(place, steps - 1));
  const double share = place - static_cast<double>(below);
  const double cell = spec_.cell_v[below] + share * (spec_.cell_v[below + 1] - spec_.cell_v[below]);
  return spec_.cells * cell;
}

// V of  V = V0 - R · P / V  with V0 the voltage of the idle pack.
void Battery::Load(double power) {
  if (cut_off_ != CutOff::kNone) {
    reading_.voltage = OpenVoltage();
    reading_.current = 0;
    return;
  }
  const double idle_v = OpenVoltage() - resistance_ * spec_.idle_a;
  const double most = idle_v * idle_v / 4;  // of R · P
  const double loss = std::min(resistance_ * power, most);
  const double full_v = std::max(idle_v, spec_.cells * spec_.cell_v.back());
  reading_.voltage = std::min(idle_v / 2 + std::sqrt(most - loss), full_v);
  double given = (loss < most ? power : most / resistance_) / reading_.voltage;
  if (power < 0 && reading_.voltage == full_v) {  // takes no more
    given = resistance_ > 0 ? (idle_v - full_v) / resistance_ : 0;
  }
  reading_.current = -(spec_.idle_a + given);
}

void Battery::Protect(double dt) {
  const double weight = dt / (spec_.cutoff_time + dt);
  mean_a_ += (-reading_.current - mean_a_) * weight;
  mean_cell_v_ += (reading_.voltage / spec_.cells + weakest_v_ - mean_cell_v_) * weight;
  if (reading_.soc <= 0) {
    cut_off_ = CutOff::kEmpty;
  } else if (spec_.cutoff_a > 0 && mean_a_ > spec_.cutoff_a) {
    cut_off_ = CutOff::kOvercurrent;
  } else if (mean_cell_v_ < spec_.cutoff_v) {
    cut_off_ = CutOff::kUndervoltage;
  }
  if (cut_off_ == CutOff::kNone) return;
  Load(0);
}

}  // namespace understudy::robot
