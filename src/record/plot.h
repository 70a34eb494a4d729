// Makes a page of plots of a recording.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "record/mcap_reader.h"

namespace understudy::record {

using TracePoints = std::vector<std::pair<double, double>>;  // s, value

// Pixel columns of a line; in each the minimum and maximum are drawn. *Assumed*.
inline constexpr std::size_t kTraceColumns = 1200;

// Returns `all`, or, if there are more points than needed, the minimum and maximum of each column
// between `from` and `to` [s], in order.
TracePoints Thinned(const TracePoints& all, double from, double to);

// The points of a line, thinned so that their number does not grow with the recording.
class Trace {
 public:
  // Adds `value` at time `at` [s] to a line from `from` to `to`. Ignores infinities and NaN.
  void Add(double at, double value, double from, double to);
  const TracePoints& points() const { return points_; }

 private:
  static constexpr std::size_t kFull = 16 * kTraceColumns;

  TracePoints points_;
  std::size_t full_ = kFull;
};

struct PlotOptions {
  std::vector<std::string> motors{};   // joints, with or without _joint, or slots; empty: of each
                                       // kind the one that moves most, six at most
  std::vector<std::string> fields{};   // of motors: q, dq, tau, temperature; empty: q, tau
  std::vector<std::string> signals{};  // "rt/lowstate:imu_state.gyroscope[2]", one panel each;
                                       // with ROS or DDS names of topics
  double from = 0, to = 0;             // s of simulated time; `to` 0: the recording's end
  int width = 1600, height = 0;        // pixels; height 0: by the number of panels
};

struct PlotLine {
  std::string name;
  int color = 0;         // index in the palette
  bool dashed = false;   // for commanded values
  TracePoints points{};  // at least one, thinned
};

struct PlotPanel {
  std::string label;  // of the y axis
  std::vector<PlotLine> lines{};
};

struct PlotMark {
  double at = 0;  // s
  std::string kind{};
  std::string text{};
  int times = 1;  // number of equal events close together
};

// A page: panels below each other on one time axis, and marks of events across all of them.
struct PlotPage {
  std::string title;
  double from = 0, to = 0;  // s
  int width = 0, height = 0;
  std::vector<PlotPanel> panels{};
  std::vector<PlotMark> marks{};
};

// Reads the recording and makes panels of base height and attitude, of the motors' fields with
// their commanded values and of the signals, and marks of the events. Throws RecordError for an
// unknown motor, field or signal, with the nearest word, and if there is nothing to draw.
PlotPage MakePage(const McapReader& reader, const PlotOptions& options);

// Returns the gnuplot script that draws a page as SVG or PNG into the file `picture`. Texts of the
// recording are quoted, so they cannot be commands.
std::string GnuplotScript(const PlotPage& page, bool svg, const std::filesystem::path& picture);

// Draws the page with gnuplot into a .png or .svg file. Throws RecordError for another extension,
// if gnuplot is missing (with its package) or fails (its message is on standard error), or if the
// file cannot be written; an existing picture is then unchanged.
void DrawPage(const PlotPage& page, const std::filesystem::path& picture);

}  // namespace understudy::record
