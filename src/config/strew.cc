#include "config/strew.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "terrain/terrain.h"

namespace understudy::config {

void StrewObjects(Config* config) {
  constexpr double kAroundStart = 0.9;  // m, from a robot's middle; assumed
  const auto is_loose = [](const objects::ObjectSpec& o) { return o.name.starts_with("loose_"); };
  if (config->terrain.clutter == 0 || std::ranges::any_of(config->objects, is_loose)) return;
  const std::array<double, 3>& start = config->robots[0].start.at;
  int number = 0;
  for (const terrain::LooseThing& thing : terrain::LooseThings(config->scene, config->terrain)) {
    if (std::hypot(thing.x - start[0], thing.y - start[1]) < kAroundStart) continue;
    objects::ObjectSpec object{.kind = thing.kind};
    object.name = "loose_" + std::to_string(++number);
    object.pos = {thing.x, thing.y, thing.z};
    object.yaw = thing.yaw;
    config->objects.push_back(std::move(object));
  }
}

}  // namespace understudy::config
