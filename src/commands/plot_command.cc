#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <spdlog/fmt/fmt.h>

#include "commands/commands.h"
#include "commands/cut_short.h"
#include "ctl/check.h"
#include "record/csv.h"
#include "record/plot.h"

namespace understudy::commands {
namespace {

// The command line.
struct PlotArguments {
  std::string file, second;
  std::string out;
  std::string size;
  double shift = 0;    // s
  bool csv = false;    // numbers instead of a picture
  bool whole = false;  // also where nothing moves
  bool part = false;   // from or to is given
  record::PlotOptions options;
};

bool IsTable(const PlotArguments& arguments) {
  return arguments.csv || std::filesystem::path(arguments.out).extension() == ".csv";
}

// The file to write: beside the recording unless told.
std::filesystem::path OutOf(const PlotArguments& arguments, const char* ending) {
  if (!arguments.out.empty()) return arguments.out;
  std::filesystem::path file = arguments.file;
  if (!file.has_filename()) file = file.parent_path();  // a bag's folder, written with a slash
  return file.replace_extension(ending);
}

constexpr double kLongest = 1e9;  // s; longer than any recording
constexpr int kLeastPixels = 400;
constexpr int kMostPixels = 10000;

// Parses "1600x900" into width and height. Returns "" or an error.
std::string ReadSize(const std::string& text, int* width, int* height) {
  int end = 0;
  const auto fits = [](int pixels) { return pixels >= kLeastPixels && pixels <= kMostPixels; };
  // NOLINTNEXTLINE(cert-err34-c): the range is checked
  if (std::sscanf(text.c_str(), "%5dx%5d%n", width, height, &end) == 2 &&
      static_cast<std::size_t>(end) == text.size() && fits(*width) && fits(*height)) {
    return {};
  }
  return "expected WIDTHxHEIGHT, each from 400 to 10000 pixels, found '" + text + "'";
}

// What stays of the time before and after what happens [s], and how much else is worth leaving it
// out; *assumed*.
constexpr double kMargin = 0.5;
constexpr double kWorthIt = 1;

// When something moves in either, on the first's clock.
record::BusySpan BusyIn(const record::RecordingReader& first, const record::RecordingReader* second,
                        double shift) {
  record::BusySpan busy = BusySpanOf(first);
  if (second == nullptr) return busy;
  record::BusySpan other = BusySpanOf(*second);
  busy.end = std::max(busy.end, other.end + shift);
  if (other.never) return busy;
  busy.from = busy.never ? other.from + shift : std::min(busy.from, other.from + shift);
  busy.to = busy.never ? other.to + shift : std::max(busy.to, other.to + shift);
  busy.never = false;
  return busy;
}

// Leaves out the time before the first and after the last movement, and says so.
void Trim(const record::BusySpan& busy, record::RunChoice* what) {
  if (busy.never) return;
  std::string left_out;
  const double from = std::max(0.0, busy.from - kMargin), to = busy.to + kMargin;
  if (from > kWorthIt) {
    what->from = from;
    left_out = fmt::format("0 to {:.1f} s", from);
  }
  if (busy.end - to > kWorthIt) {
    what->to = to;
    left_out += fmt::format("{}{:.1f} to {:.1f} s", left_out.empty() ? "" : " and ", to, busy.end);
  }
  if (left_out.empty()) return;
  std::fprintf(stderr, "nothing moves from %s: left out; --whole shows it\n", left_out.c_str());
}

int PlotCommand(PlotArguments arguments) {
  record::PlotOptions& options = arguments.options;
  const auto opened = record::OpenRecording(arguments.file);
  const record::RecordingReader& first = *opened;
  const auto second = arguments.second.empty() ? nullptr : record::OpenRecording(arguments.second);
  const record::RecordingReader* const other = second.get();
  const auto tell = [&] {
    TellCutShort(first);
    if (other != nullptr) TellCutShort(*other);
  };
  if (IsTable(arguments)) {
    const std::filesystem::path table = OutOf(arguments, ".csv");
    WriteCsv(first, other, arguments.shift, options.what, table);
    tell();
    std::printf("%s\n", table.c_str());
    return 0;
  }
  if (!arguments.whole && !arguments.part) {
    Trim(BusyIn(first, other, arguments.shift), &options.what);
  }
  const std::filesystem::path picture = OutOf(arguments, ".svg");
  record::WritePicture(other != nullptr ? record::MakePage(first, *other, arguments.shift, options)
                                        : record::MakePage(first, options),
                       picture);
  tell();
  std::printf("%s\n", picture.c_str());
  return 0;
}

}  // namespace

void AddPlotCommand(CLI::App* app, Chosen* chosen) {
  const auto arguments = std::make_shared<PlotArguments>();
  record::PlotOptions& options = arguments->options;
  CLI::App* plot = app->add_subcommand("plot", "Plot a recording, or two, or write its numbers");
  plot->add_option("file", arguments->file, "The recording, MCAP or a ROS 2 bag")
      ->required()
      ->type_name("FILE");
  CLI::Option* second = plot->add_option("second", arguments->second,
                                         "Another of the same robot, drawn over it in dashed lines")
                            ->type_name("SECOND");
  CLI::Option* out =
      plot->add_option("--out", arguments->out,
                       "Picture to write, .svg, or table, .csv; replaces an existing one "
                       "[FILE.svg]")
          ->type_name("OUT");
  CLI::Option* csv =
      plot->add_flag("--csv", arguments->csv, "Write the numbers, not a picture: FILE.csv")
          ->excludes(out);
  plot->add_option("--shift", arguments->shift,
                   "Added to the second's time, s; `understudy compare` finds what fits [0]")
      ->type_name("S")
      ->needs(second)
      ->check(ctl::NumberWithin(-kLongest, kLongest));
  plot->add_option("--motors", options.what.motors,
                   "Joints, or slots by number [of each kind the one that moves most]")
      ->type_name("NAME,...")
      ->delimiter(',');
  plot->add_option("--fields", options.what.fields,
                   "Fields of the motors: q, dq, tau, temperature [q,tau]")
      ->type_name("FIELD,...")
      ->delimiter(',');
  plot->add_option("--signals", options.what.signals,
                   "Other numbers of the vendor's messages, one panel each")
      ->type_name("TOPIC:FIELD,...")
      ->delimiter(',');
  CLI::Option* from =
      plot->add_option("--from", options.what.from,
                       "Simulated time to begin at, s [where something moves; of a table 0]")
          ->type_name("S")
          ->check(ctl::NumberWithin(0, kLongest));
  CLI::Option* to =
      plot->add_option("--to", options.what.to,
                       "Simulated time to end at, s [where the last thing has moved; of a table "
                       "the recording's end]")
          ->type_name("S")
          ->check(ctl::NumberWithin(0, kLongest));
  plot->add_flag("--whole", arguments->whole,
                 "Also the time in which nothing moves yet, or no more")
      ->excludes(from)
      ->excludes(to);
  CLI::Option* size = plot->add_option("--size", arguments->size,
                                       "Pixels [1600 wide, height by the number of panels]")
                          ->type_name("WxH")
                          ->excludes(csv)
                          ->check([&options](const std::string& text) {
                            return ReadSize(text, &options.width, &options.height);
                          });
  plot->footer(
      "Plots height and attitude of the base, joint angles and torques (commanded values dashed),\n"
      "and marks events. Of two recordings it draws the second dashed over the first, without "
      "what\n"
      "was commanded. A table has all motors unless told, a row for each time, units in its "
      "header.\n"
      "Examples:\n"
      "  understudy plot walk.mcap\n"
      "  understudy plot walk.mcap --out stand.svg --motors FR_thigh,FR_calf --from 1 --to 4\n"
      "  understudy plot walk.mcap --fields q,dq --signals 'rt/lowstate:imu_state.gyroscope[2]'\n"
      "  understudy plot before.mcap after.mcap --out change.svg\n"
      "  understudy plot walk.mcap --csv --fields q,dq,tau         walk.csv");
  plot->callback([=] {
    if (size->count() > 0 && IsTable(*arguments)) {
      throw CLI::ValidationError("--size", "a table, " + arguments->out + ", has no pixels");
    }
    arguments->part = from->count() + to->count() > 0;
    *chosen = [=] { return PlotCommand(*arguments); };
  });
}

}  // namespace understudy::commands
