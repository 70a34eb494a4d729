// What a benchmark found, and how it is shown.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace understudy::bench {

enum class Wanted { kAtLeast, kAtMost };

// One measured number. `bound` is what it is wanted to keep; missing it is no failure of the run.
struct Figure {
  std::string robot;
  std::string name;
  std::string unit;
  double value = 0;
  std::optional<double> bound{};
  Wanted wanted = Wanted::kAtMost;

  bool Met() const;  // true without a bound
};

// The middle value, or the mean of the two middle ones. `values` must not be empty.
double Median(std::vector<double> values);
// The smallest value that a share `p` (0..1) of all does not exceed. `values` must not be empty.
double Percentile(std::vector<double> values, double p);

std::string Table(const std::vector<Figure>& figures);
std::string Json(const std::vector<Figure>& figures);  // one object, in one line

}  // namespace understudy::bench
