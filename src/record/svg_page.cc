#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <system_error>

#include <unistd.h>

#include "base/printed.h"
#include "emulator/event_table.h"
#include "emulator/request.h"
#include "record/plot.h"
#include "record/svg_plot.h"

namespace understudy::record {
namespace {

// Colours that colour-blind readers can distinguish (Okabe and Ito 2008).
constexpr int kColors = 6;
constexpr char kStyle[] = R"css(
text { font: 12px "DejaVu Sans", sans-serif; fill: #3d3846; }
.title { font-size: 15px; text-anchor: middle; } .mark { font-size: 11px; }
.ylabel { text-anchor: end; } .xlabel, .axis { text-anchor: middle; }
line, path { fill: none; stroke-width: 1.4; stroke-linejoin: round; }
.grid { stroke: #e3e3e6; stroke-width: 1; } .dashed { stroke-dasharray: 6 4; stroke-width: 1.2; }
.c0 { stroke: #0072b2; } .c1 { stroke: #d55e00; } .c2 { stroke: #009e73; }
.c3 { stroke: #cc79a7; } .c4 { stroke: #e69f00; } .c5 { stroke: #56b4e9; }
.any { stroke: #5e5c64; } line.mark { stroke-dasharray: 2 3; stroke-width: 1; }
line.bad { stroke: #c01c28; } text.bad { fill: #c01c28; }
line.asked { stroke: #2e7d32; } text.asked { fill: #2e7d32; } line.told { stroke: #5e5c64; }
)css";

// Pixels; *assumed*.
constexpr double kTitle = 34, kRow = 16, kRight = 200, kBottom = 50, kCharacter = 6.2;
constexpr std::size_t kMostRows = 8;  // of texts above the panels: a tenth of a page

// How a mark is drawn: a warning, what a person or script asked for, or else.
const char* MarkClass(const std::string& kind) {
  const auto rows = emulator::EventTable();
  const auto row = std::ranges::find(rows, kind, &emulator::EventRow::name);
  if (row != rows.end() && row->level >= emulator::EventLevel::kWarning) return "mark bad";
  // A request's event has the name of the request.
  const bool asked = kind == "script" || kind == "remote" || emulator::FindRequest(kind);
  return asked ? "mark asked" : "mark told";
}

// Returns for each mark the row of its text above the top panel, so that texts do not overlap; -1
// if there is no room. Sets `count` to the number of rows.
std::vector<int> Rows(const PlotPage& page, int* count) {
  std::vector<double> free_from;  // by row
  std::vector<int> rows;
  for (const PlotMark& mark : page.marks) {
    const double wide = kCharacter * static_cast<double>(mark.text.size() + 8) *
                        (page.to - page.from) / (page.width - kSvgLeft - kRight);
    std::size_t row = 0;
    while (row < free_from.size() && free_from[row] > mark.at) ++row;
    if (row == kMostRows) {
      rows.push_back(-1);
      continue;
    }
    if (row == free_from.size()) free_from.push_back(0);
    free_from[row] = mark.at + wide;
    rows.push_back(static_cast<int>(row));
  }
  *count = static_cast<int>(free_from.size());
  return rows;
}

SvgPlot PlotOf(const PlotPanel& panel, const PlotPage& page) {
  SvgPlot plot{.label = panel.label,
               .from = page.from,
               .to = page.to,
               .width = page.width,
               .right = kRight,
               .bottom = 4,
               .times = false};
  // A gap in the data interrupts a line.
  const double gap = std::max(0.5, (page.to - page.from) / 200);
  bool dashed = false;
  for (const PlotLine& one : panel.lines) {
    dashed = dashed || one.dashed;
    plot.lines.push_back(
        {.kind = "c" + std::to_string(one.color % kColors) + (one.dashed ? " dashed" : ""),
         .points = one.points,
         .gap = gap,
         .name = one.name});
  }
  if (dashed) plot.lines.push_back({.kind = "any dashed", .name = page.dashed});
  return plot;
}

}  // namespace

std::string DrawPage(const PlotPage& page) {
  int rows = 0;
  const std::vector<int> row_of = Rows(page, &rows);
  const double top = kTitle + kRow * rows;
  const double each = (page.height - top - kBottom) / static_cast<double>(page.panels.size());
  const std::string width = std::to_string(page.width), height = std::to_string(page.height);
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + width + " " +
                    height + "\" width=\"" + width + "\" height=\"" + height + "\"><style>" +
                    kStyle + "</style><rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>" +
                    TextAt(0.5 * page.width, 22, "title", page.title);
  for (std::size_t i = 0; i < page.panels.size(); ++i) {
    SvgPlot plot = PlotOf(page.panels[i], page);
    plot.times = i + 1 == page.panels.size();
    plot.height = static_cast<int>(each);
    svg += "<g transform=\"translate(0," + Pixels(top + each * static_cast<double>(i)) + ")\">" +
           DrawAxes(plot) + "</g>\n";
  }
  const double per_second = (page.width - kSvgLeft - kRight) / (page.to - page.from);
  for (std::size_t i = 0; i < page.marks.size(); ++i) {
    const PlotMark& mark = page.marks[i];
    const std::string kind = MarkClass(mark.kind);
    const double x = kSvgLeft + (mark.at - page.from) * per_second;
    svg += "<line class=\"" + kind + "\" x1=\"" + Pixels(x) + "\" x2=\"" + Pixels(x) + "\" y1=\"" +
           Pixels(top) + "\" y2=\"" + Pixels(page.height - kBottom) + "\"/>";
    if (row_of[i] < 0) continue;
    svg += TextAt(x, kTitle + kRow * (row_of[i] + 0.5), kind,
                  mark.text + (mark.times > 1 ? " …" : ""));
  }
  return svg + TextAt(0.5 * page.width, page.height - 8, "xlabel", "time [s]") + "</svg>\n";
}

void WritePicture(const PlotPage& page, const std::filesystem::path& picture) {
  if (picture.extension() != ".svg") {
    throw RecordError(picture.string() + ": expected a name that ends in .svg or .csv");
  }
  // Into a temporary file, so that an existing picture is replaced only by a complete one.
  const std::filesystem::path part = picture.string() + "." + std::to_string(getpid()) + ".part";
  std::error_code error, ignored;
  std::ofstream out(part);
  if (!(out << DrawPage(page)) || !out.flush()) error = {errno, std::generic_category()};
  if (!error) std::filesystem::rename(part, picture, error);
  if (!error) return;
  std::filesystem::remove(part, ignored);
  throw RecordError(picture.string() + ": cannot be written: " + error.message());
}

}  // namespace understudy::record
