#include "rehearse/svg_plot.h"

#include <algorithm>
#include <cmath>

#include "base/printed.h"
#include "rehearse/judged.h"
#include "rehearse/outputs.h"

namespace understudy::rehearse {
namespace {

constexpr double kLeft = 62, kRight = 10, kTop = 10, kBottom = 24;  // pixels around the drawing

std::string Pixels(double at) { return Printed("%.1f", at); }

// Maps seconds and values to pixels.
class Frame {
 public:
  Frame(const SvgPlot& plot, double low, double high) : plot_(plot), low_(low), high_(high) {}

  double x(double at) const {
    const double share = (at - plot_.from) / (plot_.to - plot_.from);
    return kLeft + std::clamp(share, 0.0, 1.0) * (plot_.width - kLeft - kRight);
  }
  double y(double value) const {
    const double share = (value - low_) / (high_ - low_);
    return kTop + (1 - std::clamp(share, 0.0, 1.0)) * (plot_.height - kTop - kBottom);
  }
  double bottom() const { return plot_.height - kBottom; }

  std::string Line(const char* kind, double x1, double y1, double x2, double y2) const {
    return std::string("<line class=\"") + kind + "\" x1=\"" + Pixels(x1) + "\" y1=\"" +
           Pixels(y1) + "\" x2=\"" + Pixels(x2) + "\" y2=\"" + Pixels(y2) + "\"/>";
  }

  // Through the points and on to the right edge; "" without any.
  std::string Path(const char* kind, const record::TracePoints& points) const {
    if (points.empty()) return {};
    std::string path;
    for (const auto& [at, value] : points) {
      path += (path.empty() ? "M" : "L") + Pixels(x(at)) + "," + Pixels(y(value));
    }
    path += "L" + Pixels(x(plot_.to)) + "," + Pixels(y(points.back().second));
    return std::string("<path class=\"") + kind + "\" d=\"" + path + "\"/>";
  }

 private:
  const SvgPlot& plot_;
  double low_, high_;
};

std::string TextAt(double x, double y, const char* kind, const std::string& text) {
  return std::string("<text class=\"") + kind + "\" x=\"" + Pixels(x) + "\" y=\"" + Pixels(y) +
         "\">" + Escaped(text) + "</text>";
}

// The range of the y axis: all points and limits, with some room.
std::pair<double, double> RangeOf(const SvgPlot& plot) {
  std::vector<double> values = plot.limits;
  for (const auto* points : {&plot.points, &plot.others}) {
    for (const auto& [at, value] : *points) values.push_back(value);
  }
  if (values.empty()) values.push_back(0);
  const auto [low, high] = std::ranges::minmax(values);
  const double room = high > low ? 0.08 * (high - low) : std::max(1e-6, 0.1 * std::abs(high));
  return {low - room, high + room};
}

}  // namespace

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
  const auto [low, high] = RangeOf(plot);
  const Frame frame(plot, low, high);
  const double right = plot.width - kRight;
  std::string svg = "<svg viewBox=\"0 0 " + std::to_string(plot.width) + " " +
                    std::to_string(plot.height) + "\" width=\"" + std::to_string(plot.width) +
                    "\" height=\"" + std::to_string(plot.height) + "\" role=\"img\">";
  // What lies behind the line.
  if (plot.window) {
    const double begin = frame.x(plot.window->first), end = frame.x(plot.window->second);
    svg += "<rect class=\"window\" x=\"" + Pixels(begin) + "\" y=\"" + Pixels(kTop) +
           "\" width=\"" + Pixels(std::max(1.0, end - begin)) + "\" height=\"" +
           Pixels(frame.bottom() - kTop) + "\"/>";
  }
  for (const double value : Ticks(low, high, 4)) {
    svg += frame.Line("grid", kLeft, frame.y(value), right, frame.y(value)) +
           TextAt(kLeft - 6, frame.y(value) + 4, "ylabel", NumberText(value));
  }
  for (const double at : Ticks(plot.from, plot.to, plot.width / 90)) {
    svg += frame.Line("grid", frame.x(at), kTop, frame.x(at), frame.bottom()) +
           TextAt(frame.x(at), plot.height - 8, "xlabel", NumberText(at) + " s");
  }
  for (const auto& [at, what] : plot.events) {
    if (at < plot.from || at > plot.to) continue;
    svg += "<g>" +
           frame.Line("event", frame.x(at), frame.bottom() - 8, frame.x(at), frame.bottom()) +
           "<title>" + Escaped(NumberText(at) + " s: " + what) + "</title></g>";
  }
  // Limits, the signal, the instant that decided.
  for (const double limit : plot.limits) {
    svg += frame.Line("limit", kLeft, frame.y(limit), right, frame.y(limit));
  }
  svg += frame.Path("other", plot.others) + frame.Path("signal", plot.points);
  if (plot.at)
    svg += frame.Line("instant", frame.x(*plot.at), kTop, frame.x(*plot.at), frame.bottom());
  svg += "<text class=\"axis\" transform=\"rotate(-90)\" x=\"" +
         Pixels(-0.5 * (kTop + frame.bottom())) + "\" y=\"13\">" + Escaped(plot.label) + "</text>";
  return svg + "</svg>";
}

}  // namespace understudy::rehearse
