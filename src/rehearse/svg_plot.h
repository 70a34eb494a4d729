// Draws a signal over time as SVG.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "record/plot.h"

namespace understudy::rehearse {

struct SvgPlot {
  std::string label{};           // of the y axis
  double from = 0, to = 1;       // s
  record::TracePoints points{};  // s and value; a step is two points of one time
  record::TracePoints others{};  // of the signal with which it is compared
  std::vector<double> limits{};  // values that the signal is compared with
  std::optional<std::pair<double, double>> window{};  // s: shaded
  std::optional<double> at{};                         // s: the instant that decided
  std::vector<std::pair<double, std::string>>
      events{};                   // s and what happened: ticks with a tooltip
  int width = 640, height = 190;  // pixels
};

// Returns an <svg> element whose colours are the classes of the report's style sheet.
std::string DrawSvg(const SvgPlot& plot);

// Returns round values for an axis from `low` to `high`, about `count` of them.
std::vector<double> Ticks(double low, double high, int count);

}  // namespace understudy::rehearse
