// Makes a page of plots of a recording.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "record/recording_reader.h"
#include "record/run_reader.h"

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
  RunChoice what{};              // no motors: of each kind the one that moves most, six at most
  int width = 1600, height = 0;  // pixels; height 0: by the number of panels
};

struct PlotLine {
  std::string name;
  int color = 0;         // index in the palette
  bool dashed = false;   // for commanded values, or for another recording
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
  std::vector<int> slots{};          // of the motors whose lines these are
  std::string dashed = "commanded";  // what dashed lines are
};

// Reads the recording and makes panels of base height and attitude, of the motors' fields with
// their commanded values and of the signals, and marks of the events. Throws RecordError for an
// unknown motor, field or signal, with the nearest word, and if there is nothing to draw.
PlotPage MakePage(const RecordingReader& reader, const PlotOptions& options);

// The same of `first`, with the lines of the same panels of `second`, a robot with the same slots,
// dashed in the place of what was commanded, and its marks under its file's name; `shift` s are
// added to its time. Throws as above, and where the two have no time in common.
PlotPage MakePage(const RecordingReader& first, const RecordingReader& second, double shift,
                  const PlotOptions& options);

// Returns the page as an SVG document. Texts of the recording are escaped.
std::string DrawPage(const PlotPage& page);

// Writes it into an .svg file. Throws RecordError for another extension, or if the file cannot be
// written; an existing picture is then unchanged.
void WritePicture(const PlotPage& page, const std::filesystem::path& picture);

}  // namespace understudy::record
