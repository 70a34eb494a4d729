// Draws signals over time as SVG, for pictures of recordings and for reports.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "record/plot.h"

namespace understudy::record {

struct SvgLine {
  std::string kind{};    // classes of a style sheet
  TracePoints points{};  // s and value; a step is two points of one time
  // A longer pause [s] interrupts the line; 0: a value holds until the next, the last to the end.
  double gap = 0;
  std::string name{};  // beside the axes; "" for none
};

struct SvgPlot {
  std::string label{};                                // of the y axis
  double from = 0, to = 1;                            // s
  std::vector<SvgLine> lines{};                       // the first drawn last
  std::vector<double> limits{};                       // values that the signal is compared with
  std::optional<std::pair<double, double>> window{};  // s: shaded
  std::optional<double> at{};                         // s: the instant that decided
  std::vector<std::pair<double, std::string>>
      events{};                    // s and what happened: ticks with a tooltip
  int width = 640, height = 190;   // pixels
  double right = 10, bottom = 24;  // pixels beside and below the axes
  bool times = true;               // numbers at the time axis
};

// Returns an <svg> element whose colours are the classes of the page's style sheet.
std::string DrawSvg(const SvgPlot& plot);

// Returns its content, to be placed in an <svg> of others.
std::string DrawAxes(const SvgPlot& plot);

// Returns a pixel's coordinate as text.
std::string Pixels(double at);

// Returns a <text> element of the style's `kind` at these pixels.
std::string TextAt(double x, double y, const std::string& kind, const std::string& text);

// Pixels left of the axes.
inline constexpr double kSvgLeft = 62;

// Returns round values for an axis from `low` to `high`, about `count` of them.
std::vector<double> Ticks(double low, double high, int count);

}  // namespace understudy::record
