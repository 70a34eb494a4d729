// What a fit tells on its way.
#pragma once

#include <functional>
#include <string>

namespace understudy::identify {

struct FitTold {
  std::function<void(const std::string&)> line{};      // for people
  std::function<void(int done, int most)> progress{};  // steps; `most` may not be needed
};

}  // namespace understudy::identify
