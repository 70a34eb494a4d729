#include "record/svg_plot.h"

#include <algorithm>
#include <cmath>

#include "base/printed.h"

namespace understudy::record {
namespace {

constexpr double kTop = 10;         // pixels above the axes
constexpr double kLegendRow = 16;   // pixels
constexpr double kLegendLine = 22;  // pixels: the sample beside a name

// Maps seconds and values to pixels.
class Frame {
 public:
  Frame(const SvgPlot& plot, double low, double high) : plot_(plot), low_(low), high_(high) {}

  double x(double at) const {
    const double share = (at - plot_.from) / (plot_.to - plot_.from);
    return kSvgLeft + std::clamp(share, 0.0, 1.0) * (right() - kSvgLeft);
  }
  double y(double value) const {
    const double share = (value - low_) / (high_ - low_);
    return kTop + (1 - std::clamp(share, 0.0, 1.0)) * (bottom() - kTop);
  }
  double right() const { return plot_.width - plot_.right; }
  double bottom() const { return plot_.height - plot_.bottom; }

  std::string Line(const std::string& kind, double x1, double y1, double x2, double y2) const {
    return "<line class=\"" + kind + "\" x1=\"" + Pixels(x1) + "\" y1=\"" + Pixels(y1) +
           "\" x2=\"" + Pixels(x2) + "\" y2=\"" + Pixels(y2) + "\"/>";
  }

  std::string Path(const SvgLine& line) const {
    if (line.points.empty()) return {};
    std::string path;
    double last = -HUGE_VAL;
    for (const auto& [at, value] : line.points) {
      const bool begins = path.empty() || (line.gap > 0 && at - last > line.gap);
      path += (begins ? "M" : "L") + Pixels(x(at)) + "," + Pixels(y(value));
      last = at;
    }
    if (line.gap == 0)
      path += "L" + Pixels(x(plot_.to)) + "," + Pixels(y(line.points.back().second));
    return "<path class=\"" + line.kind + "\" d=\"" + path + "\"/>";
  }

 private:
  const SvgPlot& plot_;
  double low_, high_;
};

// The range of the y axis: all points and limits, with some room.
std::pair<double, double> RangeOf(const SvgPlot& plot) {
  std::vector<double> values = plot.limits;
  for (const SvgLine& line : plot.lines) {
    for (const auto& [at, value] : line.points) values.push_back(value);
  }
  if (values.empty()) values.push_back(0);
  const auto [low, high] = std::ranges::minmax(values);
  const double room = high > low ? 0.08 * (high - low) : std::max(1e-6, 0.1 * std::abs(high));
  return {low - room, high + room};
}

// The names of the lines, right of the axes.
std::string Legend(const Frame& frame, const SvgPlot& plot) {
  std::string svg;
  double y = kTop + 10;
  for (const SvgLine& line : plot.lines) {
    if (line.name.empty()) continue;
    const double x = frame.right() + 12;
    svg += frame.Line(line.kind, x, y - 4, x + kLegendLine, y - 4) +
           TextAt(x + kLegendLine + 6, y, "legend", line.name);
    y += kLegendRow;
  }
  return svg;
}

}  // namespace

std::string Pixels(double at) { return Printed("%.1f", at); }

std::string TextAt(double x, double y, const std::string& kind, const std::string& text) {
  return "<text class=\"" + kind + "\" x=\"" + Pixels(x) + "\" y=\"" + Pixels(y) + "\">" +
         Escaped(text) + "</text>";
}

std::vector<double> Ticks(double low, double high, int count) {
  const double rough = (high - low) / count;
  if (!(rough > 0) || !std::isfinite(rough)) return {low};
  const double power = std::pow(10, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough) {
      step = factor * power;
      break;
    }
  }
  std::vector<double> ticks;
  for (double i = std::ceil(low / step); i * step <= high * (1 + 1e-12); ++i) {
    ticks.push_back(i == 0 ? 0 : i * step);
  }
  return ticks;
}

std::string DrawSvg(const SvgPlot& plot) {
  const std::string width = std::to_string(plot.width), height = std::to_string(plot.height);
  return "<svg viewBox=\"0 0 " + width + " " + height + "\" width=\"" + width + "\" height=\"" +
         height + "\" role=\"img\">" + DrawAxes(plot) + "</svg>";
}

std::string DrawAxes(const SvgPlot& plot) {
  const auto [low, high] = RangeOf(plot);
  const Frame frame(plot, low, high);
  std::string svg;
  // What lies behind the lines.
  if (plot.window) {
    const double begin = frame.x(plot.window->first), end = frame.x(plot.window->second);
    svg += "<rect class=\"window\" x=\"" + Pixels(begin) + "\" y=\"" + Pixels(kTop) +
           "\" width=\"" + Pixels(std::max(1.0, end - begin)) + "\" height=\"" +
           Pixels(frame.bottom() - kTop) + "\"/>";
  }
  for (const double value : Ticks(low, high, 4)) {
    svg += frame.Line("grid", kSvgLeft, frame.y(value), frame.right(), frame.y(value)) +
           TextAt(kSvgLeft - 6, frame.y(value) + 4, "ylabel", Printed("%.6g", value));
  }
  for (const double at : Ticks(plot.from, plot.to, plot.width / 90)) {
    svg += frame.Line("grid", frame.x(at), kTop, frame.x(at), frame.bottom());
    if (!plot.times) continue;
    svg += TextAt(frame.x(at), frame.bottom() + 16, "xlabel", Printed("%.6g s", at));
  }
  for (const auto& [at, what] : plot.events) {
    if (at < plot.from || at > plot.to) continue;
    svg += "<g>" +
           frame.Line("event", frame.x(at), frame.bottom() - 8, frame.x(at), frame.bottom()) +
           "<title>" + Escaped(Printed("%.6g s: ", at) + what) + "</title></g>";
  }
  // Limits, the lines, the instant that decided.
  for (const double limit : plot.limits) {
    svg += frame.Line("limit", kSvgLeft, frame.y(limit), frame.right(), frame.y(limit));
  }
  for (auto line = plot.lines.rbegin(); line != plot.lines.rend(); ++line) svg += frame.Path(*line);
  if (plot.at) {
    svg += frame.Line("instant", frame.x(*plot.at), kTop, frame.x(*plot.at), frame.bottom());
  }
  return svg + Legend(frame, plot) + "<text class=\"axis\" transform=\"rotate(-90)\" x=\"" +
         Pixels(-0.5 * (kTop + frame.bottom())) + "\" y=\"13\">" + Escaped(plot.label) + "</text>";
}

}  // namespace understudy::record
