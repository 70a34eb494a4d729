#include <cstdio>
#include <memory>
#include <optional>

#include "commands/commands.h"
#include "commands/cut_short.h"
#include "ctl/check.h"
#include "record/output_file.h"
#include "rehearse/compare.h"

namespace understudy::commands {
namespace {

// The command line.
struct CompareArguments {
  std::string first, second, out;
  double shift = 0;
  bool shifted = false, json = false;
};

constexpr double kLongestShift = 1e9;  // s; longer than any recording

int CompareCommand(const CompareArguments& arguments) {
  const auto first = record::OpenRecording(arguments.first);
  const auto second = record::OpenRecording(arguments.second);
  const rehearse::Differences comparison = rehearse::Compare(
      *first, *second, arguments.shifted ? std::optional(arguments.shift) : std::nullopt);
  TellCutShort(*first);
  TellCutShort(*second);
  std::fputs((arguments.json ? CompareJson(comparison) : CompareText(comparison)).c_str(), stdout);
  if (arguments.out.empty()) return 0;
  record::OutputFile(arguments.out, true).Write(record::AsBytes(CompareHtml(comparison)));
  if (!arguments.json) std::printf("\n%s\n", arguments.out.c_str());
  return 0;
}

}  // namespace

void AddCompareCommand(CLI::App* app, Chosen* chosen) {
  const auto arguments = std::make_shared<CompareArguments>();
  CLI::App* compare = app->add_subcommand("compare", "Show where two recordings of a robot differ");
  compare
      ->add_option("first", arguments->first,
                   "A recording, MCAP or a ROS 2 bag, such as that of a rehearsal")
      ->required()
      ->type_name("FIRST");
  compare->add_option("second", arguments->second, "Another one, such as that of the real robot")
      ->required()
      ->type_name("SECOND");
  compare
      ->add_option("--out", arguments->out,
                   "Page with plots to write, .html; an existing one is replaced [none]")
      ->type_name("PAGE");
  CLI::Option* shift =
      compare
          ->add_option(
              "--shift", arguments->shift,
              "Seconds that are added to the times of the second recording, each counted from its "
              "first LowState; negative is earlier [found from the movements of the joints]")
          ->type_name("S")
          ->check(ctl::NumberWithin(-kLongestShift, kLongestShift));
  compare->add_flag("--json", arguments->json, "Print one JSON document");
  compare->footer(
      "Aligns the two in time. Compares angle, speed and torque of each joint, how closely\n"
      "and how late it follows its commands (rt/lowcmd), the inertial unit and the battery.\n"
      "Examples:\n"
      "  understudy compare rehearsals/push/recording.mcap real.mcap\n"
      "  understudy compare sim.mcap real.mcap --out compare.html\n"
      "  understudy compare sim.mcap real.mcap --json | jq '.motors[] | [.joint, .q.rms]'");
  compare->callback([=] {
    arguments->shifted = shift->count() > 0;
    *chosen = [=] { return CompareCommand(*arguments); };
  });
}

}  // namespace understudy::commands
