// The picture of a run.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "record/mcap_reader.h"

namespace understudy::record {

using TracePoints = std::vector<std::pair<double, double>>;  // s, value

// Columns of pixels of a line: of each the least and the most is drawn; *assumed*.
inline constexpr std::size_t kTraceColumns = 1200;

// `all`, of `from` to `to` [s], or of each column the least and the most, in order.
TracePoints Thinned(const TracePoints& all, double from, double to);

// No more than a few times what is drawn, however long the recording is.
class Trace {
 public:
  // Adds `value` at `at` [s] of a line from `from` to `to`, but none that no line can go through.
  void Add(double at, double value, double from, double to);
  const TracePoints& points() const { return points_; }

 private:
  static constexpr std::size_t kFull = 16 * kTraceColumns;

  TracePoints points_;
  std::size_t full_ = kFull;
};

struct PlotOptions {
  std::vector<std::string> motors{};   // joints, with or without _joint, or slots; empty: of each
                                       // kind the one that moves most, at most six
  std::vector<std::string> fields{};   // of motors: q, dq, tau, temperature; empty: q, tau
  std::vector<std::string> signals{};  // "rt/lowstate:imu_state.gyroscope[2]", each a panel more;
                                       // topics as ROS or as DDS spells them
  double from = 0, to = 0;             // s of simulated time; `to` 0: the recording's end
  int width = 1600, height = 0;        // pixels; height 0: by the number of panels
};

struct PlotLine {
  std::string name;
  int color = 0;         // of the palette
  bool dashed = false;   // what was commanded
  TracePoints points{};  // one at least, few enough to be drawn
};

struct PlotPanel {
  std::string label;  // of its y axis
  std::vector<PlotLine> lines{};
};

struct PlotMark {
  double at = 0;  // s
  std::string kind{};
  std::string text{};
  int times = 1;  // of the same, close together
};

// A page: panels below one another over the same time, and marks that go through all of them.
struct PlotPage {
  std::string title;
  double from = 0, to = 0;  // s
  int width = 0, height = 0;
  std::vector<PlotPanel> panels{};
  std::vector<PlotMark> marks{};
};

// Base height and attitude, the fields of the motors with what was commanded, the signals, and
// events. Throws RecordError with the nearest word for a motor, field or signal that there is not,
// and where there is nothing to be drawn.
PlotPage MakePage(const McapReader& reader, const PlotOptions& options);

// What gnuplot is told for a page, to draw it as SVG or as PNG into the file `picture`. Texts may
// be anybody's: they are only ever quoted words.
std::string GnuplotScript(const PlotPage& page, bool svg, const std::filesystem::path& picture);

// Draws the page with gnuplot into a .png or .svg. Throws RecordError: another ending, no gnuplot
// (with the package that brings it), gnuplot's failure, of which it tells on standard error, or a
// picture that cannot be written; then the one of before is still there.
void DrawPage(const PlotPage& page, const std::filesystem::path& picture);

}  // namespace understudy::record
