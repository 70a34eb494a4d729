#include "robot/pads.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "robot/hand_law.h"

namespace understudy::robot {

std::vector<std::string> PadNames(const RobotSpec& spec) {
  constexpr std::string_view kEnd = "_touch";
  std::vector<std::string> names;
  for (const HandSpec& hand : spec.hands) {
    for (const PadSpec& pad : hand.pads) {
      names.push_back(pad.site);
      if (pad.site.ends_with(kEnd)) names.back().resize(pad.site.size() - kEnd.size());
    }
  }
  return names;
}

std::size_t CellsOf(const RobotSpec& spec) {
  std::size_t cells = 0;
  for (const HandSpec& hand : spec.hands) cells += CellsOf(hand);
  return cells;
}

void StrongestCells(const RobotSpec& spec, std::span<const float> cells, std::span<double> pads) {
  auto strongest = pads.begin();
  for (const HandSpec& hand : spec.hands) {
    for (const PadSpec& pad : hand.pads) {
      const std::span<const float> own = cells.first(CellsOf(pad));
      cells = cells.subspan(own.size());
      *strongest++ = own.empty() ? 0 : static_cast<double>(*std::ranges::max_element(own));
    }
  }
}

}  // namespace understudy::robot
