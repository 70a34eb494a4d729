#include <cstdio>
#include <filesystem>
#include <memory>

#include "commands/commands.h"
#include "ctl/check.h"
#include "record/plot.h"

namespace understudy::commands {
namespace {

// The command line.
struct PlotArguments {
  std::string file;
  std::string out;
  std::string size;
  record::PlotOptions options;
};

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

int PlotCommand(const PlotArguments& arguments) {
  const std::filesystem::path picture =
      arguments.out.empty() ? std::filesystem::path(arguments.file).replace_extension(".png")
                            : std::filesystem::path(arguments.out);
  const record::McapReader reader(arguments.file);
  if (!reader.contents().cut_short.empty()) {
    std::fprintf(stderr, "the recording was cut short: %s\n", reader.contents().cut_short.c_str());
  }
  record::DrawPage(record::MakePage(reader, arguments.options), picture);
  std::printf("%s\n", picture.c_str());
  return 0;
}

}  // namespace

void AddPlotCommand(CLI::App* app, Chosen* chosen) {
  const auto arguments = std::make_shared<PlotArguments>();
  record::PlotOptions& options = arguments->options;
  CLI::App* plot = app->add_subcommand("plot", "Plot a recording");
  plot->add_option("file", arguments->file, "The recording, MCAP")->required()->type_name("FILE");
  plot->add_option("--out", arguments->out,
                   "Picture to write, .png or .svg; replaces an existing one [FILE.png]")
      ->type_name("PICTURE");
  plot->add_option("--motors", options.motors,
                   "Joints, or slots by number [of each kind the one that moves most]")
      ->type_name("NAME,...")
      ->delimiter(',');
  plot->add_option("--fields", options.fields,
                   "Fields of the motors: q, dq, tau, temperature [q,tau]")
      ->type_name("FIELD,...")
      ->delimiter(',');
  plot->add_option("--signals", options.signals,
                   "Other numbers of the vendor's messages, one panel each")
      ->type_name("TOPIC:FIELD,...")
      ->delimiter(',');
  plot->add_option("--from", options.from, "Simulated time to begin at, s [0]")
      ->type_name("S")
      ->check(ctl::NumberWithin(0, kLongest));
  plot->add_option("--to", options.to, "Simulated time to end at, s [the recording's end]")
      ->type_name("S")
      ->check(ctl::NumberWithin(0, kLongest));
  plot->add_option("--size", arguments->size, "Pixels [1600 wide, height by the number of panels]")
      ->type_name("WxH")
      ->check([&options](const std::string& text) {
        return ReadSize(text, &options.width, &options.height);
      });
  plot->footer(
      "Plots height and attitude of the base, joint angles and torques (commanded values dashed),\n"
      "and marks events. It needs gnuplot: apt-get install gnuplot-nox.\n"
      "Examples:\n"
      "  understudy plot walk.mcap\n"
      "  understudy plot walk.mcap --out stand.svg --motors FR_thigh,FR_calf --from 1 --to 4\n"
      "  understudy plot walk.mcap --fields q,dq --signals 'rt/lowstate:imu_state.gyroscope[2]'");
  plot->callback([=] { *chosen = [=] { return PlotCommand(*arguments); }; });
}

}  // namespace understudy::commands
