#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <system_error>

#include <unistd.h>

#include "exec/command.h"
#include "record/plot.h"

namespace understudy::record {
namespace {

// Colours that colour-blind readers can distinguish (Okabe and Ito 2008).
constexpr auto kPalette =
    std::to_array<const char*>({"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"});

// Margins beside the panels [pixels]: for numbers and labels, for legends.
constexpr double kLeft = 105;
constexpr double kRight = 210;

// Quotes a text for gnuplot: within single quotes no character has a special meaning.
std::string Quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') quoted += '\'';
    quoted += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return quoted + "'";
}

const char* ColorOf(const std::string& kind) {
  if (kind == "refused" || kind == "divergence" || kind == "timeout" || kind == "stall" ||
      kind == "silence" || kind == "script_refused") {
    return "#c01c28";
  }
  if (kind == "script" || kind == "order" || kind == "remote") return "#2e7d32";
  return "#5e5c64";
}

// The most rows of texts; *assumed*, a tenth of a page.
constexpr std::size_t kMostRows = 8;

// Returns for each mark the row of its text above the top panel, so that texts do not overlap; -1
// if there is no room. Sets `count` to the number of rows.
std::vector<int> Rows(const PlotPage& page, int* count) {
  std::vector<double> free_from;  // by row
  std::vector<int> rows;
  for (const PlotMark& mark : page.marks) {
    constexpr double kCharacter = 6.2;  // pixels
    const double wide = kCharacter * static_cast<double>(mark.text.size() + 8) *
                        (page.to - page.from) / (page.width - kLeft - kRight);
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

}  // namespace

std::string GnuplotScript(const PlotPage& page, bool svg, const std::filesystem::path& picture) {
  // Terminal, title and layout.
  std::ostringstream out;
  out.precision(9);
  out << "set encoding utf8\n"
      << "set terminal " << (svg ? "svg noenhanced" : "pngcairo noenhanced") << " size "
      << page.width << "," << page.height << " font 'DejaVu Sans,11' background rgb '#ffffff'\n"
      << "set output " << Quoted(picture.string()) << "\n";
  int rows = 0;
  const std::vector<int> row_of = Rows(page, &rows);
  const double line = 16.0 / page.height;
  const double top = 1 - (34.0 / page.height + line * rows + 12.0 / page.height);
  out << "set label 999 " << Quoted(page.title) << " at screen 0.5, screen "
      << 1 - 18.0 / page.height << " center font 'DejaVu Sans,13' noenhanced\n"
      << "set multiplot layout " << page.panels.size() << ",1 margins screen " << kLeft / page.width
      << "," << 1 - kRight / page.width << "," << 62.0 / page.height << "," << top
      << " spacing screen " << 14.0 / page.height << "\n"
      << "set style line 100 lc rgb '#e3e3e6' lw 1\nset grid ls 100\n"
      << "set border 3 lc rgb '#77767b'\nset tics nomirror out scale 0.5\n"
      << "set key at graph 1.01, graph 1 left top vertical Left reverse samplen 1.5 noenhanced\n"
      << "set xrange [" << page.from << ":" << page.to << "]\n"
      << "set autoscale y\nset offsets 0,0,graph 0.05,graph 0.05\n"
      << "set format y '%g'\nset format x ''\nunset xlabel\n";
  // Data, one block per panel.
  const double gap = std::max(0.5, (page.to - page.from) / 200);
  for (std::size_t i = 0; i < page.panels.size(); ++i) {
    out << "$lines" << i << " << EOD\n";
    for (const PlotLine& one : page.panels[i].lines) {
      double last = page.from;
      for (const auto& [at, value] : one.points) {
        if (at - last > gap) out << "\n";  // a gap in the data interrupts the line
        out << at << " " << value << "\n";
        last = at;
      }
      out << "\n\n";
    }
    out << "EOD\n";
  }
  // Panels with marks and lines.
  for (std::size_t i = 0; i < page.panels.size(); ++i) {
    const PlotPanel& panel = page.panels[i];
    if (i + 1 == page.panels.size()) out << "set format x '%g'\nset xlabel 'time [s]'\n";
    out << "set ylabel " << Quoted(panel.label) << " noenhanced offset 1\n";
    for (std::size_t mark = 0; mark < page.marks.size(); ++mark) {
      const PlotMark& one = page.marks[mark];
      out << "set arrow " << mark + 1 << " from first " << one.at << ", graph 0 to first " << one.at
          << ", graph 1 nohead lw 1 dt 3 lc rgb '" << ColorOf(one.kind) << "'\n";
      if (i > 0 || row_of[mark] < 0) continue;
      const std::string times = one.times > 1 ? " …" : "";
      out << "set label " << mark + 1 << " " << Quoted(one.text + times) << " at first " << one.at
          << ", screen " << top + line * (row_of[mark] + 0.75)
          << " left font 'DejaVu Sans,9' tc rgb '" << ColorOf(one.kind) << "' noenhanced\n";
    }
    out << "plot ";
    for (std::size_t index = 0; index < panel.lines.size(); ++index) {
      const PlotLine& one = panel.lines[index];
      const auto color = static_cast<std::size_t>(one.color) % kPalette.size();
      out << (index == 0 ? "" : ", ") << "$lines" << i << " index " << index
          << " using 1:2 with lines lw " << (one.dashed ? "1.2 dt (6,4)" : "1.4") << " lc rgb '"
          << kPalette[color] << "' "
          << (one.name.empty() ? "notitle" : "title " + Quoted(one.name));
    }
    if (std::ranges::any_of(panel.lines, &PlotLine::dashed)) {
      out << ", NaN with lines lw 1.2 dt (6,4) lc rgb '#5e5c64' title " << Quoted(page.dashed);
    }
    out << "\nunset label\n";
  }
  out << "unset multiplot\n";
  return out.str();
}

void DrawPage(const PlotPage& page, const std::filesystem::path& picture) {
  const std::string ending = picture.extension();
  if (ending != ".png" && ending != ".svg") {
    throw RecordError(picture.string() + ": expected a name that ends in .png or .svg");
  }
  try {
    const char* path = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe)
    exec::FindProgram("gnuplot", path == nullptr ? "" : path);
  } catch (const exec::CommandError&) {
    throw RecordError(
        "gnuplot, which draws the pictures, is missing: apt-get install "
        "gnuplot-nox");
  }
  // Draws into a temporary file, so that an existing picture is replaced only by a complete one.
  const std::filesystem::path part = picture.string() + "." + std::to_string(getpid()) + ".part";
  std::error_code error, ignored;
  if (!std::ofstream(part)) error = {errno, std::generic_category()};
  if (!error) {
    std::signal(SIGPIPE, SIG_IGN);  // if gnuplot ends early, its exit status shows it
    // -d: ignores ~/.gnuplot.
    std::FILE* gnuplot = ::popen("exec gnuplot -d", "w");
    if (gnuplot == nullptr) throw RecordError("gnuplot cannot be run");
    std::fputs(GnuplotScript(page, ending == ".svg", part).c_str(), gnuplot);
    if (::pclose(gnuplot) != 0 || std::filesystem::is_empty(part, ignored)) {
      std::filesystem::remove(part, ignored);
      throw RecordError("gnuplot failed");
    }
    std::filesystem::rename(part, picture, error);
  }
  if (!error) return;
  std::filesystem::remove(part, ignored);
  throw RecordError(picture.string() + ": cannot be written: " + error.message());
}

}  // namespace understudy::record
