#include "robot/board.h"

#include <cmath>
#include <cstddef>

namespace understudy::robot {
namespace {

constexpr double kSettled = 1e-4;  // of the rise, far less than a thermometer shows

}  // namespace

Board::Board(const RobotSpec& spec) : spec_(spec) {
  const std::array<FanEffects, 4> fine{};
  Step(0, std::span(fine).first(spec.fans.size()), {});
}

void Board::Step(double dt, std::span<const FanEffects> fans, const BoardEffects& fault) {
  double missing = 0;
  for (const FanEffects& fan : fans) missing += (1 - fan.share) / static_cast<double>(fans.size());
  const double steady = 1 + (spec_.board.still_air - 1) * missing;
  rise_ += (steady - rise_) * dt / (spec_.board.time_constant + dt);
  if (std::abs(steady - rise_) < kSettled) rise_ = steady;
  settled_ = rise_ == 1 && missing == 0 && fault.heat_c == 0 && !fault.mute;
  reading_.mute = fault.mute;
  if (fault.mute) return;
  reading_.stalled = 0;
  for (std::size_t i = 0; i < fans.size(); ++i) {
    const FanSpec& fan = spec_.fans[i];
    reading_.fan_rpm[static_cast<std::size_t>(fan.place)] = fan.rpm * fans[i].share;
    if (fans[i].share == 0) reading_.stalled |= static_cast<std::uint8_t>(fan.stall_bit);
  }
  const double air_c = spec_.thermal.ambient_c + fault.heat_c;
  reading_.centre_c = air_c + spec_.board.centre_rise_c * rise_;
  reading_.charger_c = air_c + spec_.board.charger_rise_c * rise_;
}

}  // namespace understudy::robot
