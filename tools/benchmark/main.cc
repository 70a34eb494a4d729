// Measures the daemon from outside: see docs/dev/performance.md.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "batch.h"
#include "client.h"
#include "clock.h"
#include "config/data_dir.h"
#include "config/load.h"
#include "config/robot_file.h"
#include "estimate.h"
#include "exec/private_network.h"
#include "figure.h"
#include "latency.h"
#include "perception.h"
#include "pictures.h"
#include "rehearsals.h"
#include "stepping.h"
#include "walking.h"

namespace understudy::bench {
namespace {

struct Effort {
  Rounds rounds;       // of daemon against bare MuJoCo
  int samples = 1000;  // of latency
  int starts = 5;
  double memory_after = 5;  // s
  double walk = 8;          // simulated s
  int rehearsals = 1000;
  int clouds = 200;
  double pictures = 10;  // s
  ClockEffort clock{};
  BatchEffort batch{};
};
constexpr Effort kBrief = {
    .rounds = {.count = 3, .window = 0.1, .settle = 1000},
    .samples = 50,
    .starts = 1,
    .memory_after = 0.2,
    .walk = 1,
    .rehearsals = 4,
    .clouds = 2,
    .pictures = 1,
    .clock = {.seconds = 2, .speeds = 1, .pairs = 1, .flooded = 1, .rehearsals = 2},
    .batch = {.robots = 4, .rounds = 1}};

// Of the stepping; the other figures are of these robots in their own start, without hands.
constexpr Doing kDoings[] = {
    {.robot = "go2", .start = "standing"},
    {.robot = "go2", .start = "standing", .ahead = 0.5, .wanted = 0.85},
    {.robot = "g1", .start = "hanging"},
    {.robot = "g1", .start = "hanging", .hands = "inspire", .wanted = 0.85},
};

// Without a reader, then with one.
std::vector<Figure> MeasureBoth(const std::string& understudy, const Doing& doing,
                                const Rounds& rounds) {
  std::vector<Figure> figures = MeasureStepping(understudy, doing, /*listener=*/false, rounds);
  const std::vector<Figure> read = MeasureStepping(understudy, doing, /*listener=*/true, rounds);
  figures.insert(figures.end(), read.begin(), read.end());
  return figures;
}

int Main(int argc, char** argv) {
  CLI::App app(
      "Measures Understudy on this machine, in a private network: the speed of the whole daemon\n"
      "against bare MuJoCo, the way of a command against a bare DDS round trip, memory, start, "
      "how\n"
      "well a quadruped's motion service knows how it moves and what it takes to walk, and how "
      "fast\n"
      "rehearsals go.\n"
      "Prints what is wanted beside what was measured; a missed figure is no failure.",
      "bench");
  bool json = false, brief = false;
  bool only_start = false, only_rehearsals = false, only_further = false;
  bool only_perception = false, only_clock = false, only_batch = false, only_stepping = false;
  ClockedProgram program;
  std::string understudy =
      std::filesystem::read_symlink("/proc/self/exe").parent_path() / "understudy";
  std::string helper, helper_robot;
  app.add_flag("--json", json, "Print one JSON object instead of a table");
  app.add_flag("--brief", brief, "A few seconds of each, only to see that it works");
  app.add_flag("--start", only_start, "Only how long each robot takes to its first LowState");
  app.add_flag("--rehearsals", only_rehearsals, "Only how fast a campaign of rehearsals goes");
  app.add_flag("--further", only_further, "Only what a further robot in one world takes");
  app.add_flag("--stepping", only_stepping, "Only the daemon against bare MuJoCo");
  app.add_flag("--perception", only_perception,
               "Only what a lidar's rays and a camera's pictures take");
  app.add_flag("--batch", only_batch, "Only what robots side by side take in one process");
  app.add_option("--understudy", understudy, "The program to measure [the one beside this]")
      ->check(CLI::ExistingFile);
  app.add_flag("--clock", only_clock,
               "Only programs on the simulated clock: the C client of the tests, or the command "
               "after --");
  app.add_option("--times", program.times, "Simulated s per s that are wanted of it [15]");
  app.add_flag("--released", program.released, "Without a motion service");
  app.add_option("--script", program.script, "What happens meanwhile, as for `understudy exec`")
      ->check(CLI::ExistingFile);
  app.add_option("command", program.command, "A program for --clock, and its arguments, after --")
      ->type_name("CMD...");
  app.add_option("--helper", helper)->group("");  // this program as its own other end
  app.add_option("--robot", helper_robot, "The robot of --clock [go2]");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (!helper.empty()) RunHelper(helper, helper_robot);

  const Effort effort = brief ? kBrief : Effort{};
  std::vector<Figure> figures;
  const auto print = [&] {
    std::fputs((json ? Json(figures) : Table(figures)).c_str(), stdout);
    return 0;
  };
  const auto add = [&figures](const std::vector<Figure>& more) {
    figures.insert(figures.end(), more.begin(), more.end());
  };
  if (!only_start && !only_rehearsals && !only_further && !only_clock && !only_batch &&
      !only_stepping) {
    figures = MeasurePerception(effort.clouds);
  }
  if (only_batch) {
    figures = MeasureBatch(effort.batch);
    return print();
  }
  exec::EnterPrivateNetwork();
  if (only_perception) {
    add(MeasurePictures(understudy, effort.pictures));
    return print();
  }
  if (only_stepping) {
    for (const Doing& one : kDoings) add(MeasureBoth(understudy, one, effort.rounds));
    return print();
  }
  if (only_clock) {
    if (!helper_robot.empty()) program.robot = helper_robot;
    figures = MeasureClock(understudy, program, effort.clock);
    return print();
  }
  if (!only_start && !only_further) add(MeasureRehearsals(understudy, "go2", effort.rehearsals));
  for (const Doing& one : kDoings) {
    if (only_start || only_rehearsals) break;
    if (!only_further) add(MeasureBoth(understudy, one, effort.rounds));
    if (one.ahead != 0 || one.hands != std::string("none")) continue;
    figures.push_back(MeasureFurtherRobot(understudy, one.robot, effort.rounds));
    if (only_further) continue;
    add(MeasureLatency(understudy, one.robot, effort.samples));
    add(MeasureMemory(understudy, one.robot, effort.memory_after));
  }
  for (const std::string& robot : config::RobotNames(config::DataDir())) {
    if (only_rehearsals || only_further) break;
    if (!only_start) {
      add(MeasureEstimate(robot));
      add(MeasureWalking(robot, effort.walk));
    }
    figures.push_back(MeasureStart(understudy, robot, effort.starts));
  }
  return print();
}

}  // namespace
}  // namespace understudy::bench

int main(int argc, char** argv) {
  try {
    return understudy::bench::Main(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench: %s\n", error.what());
    return 1;
  }
}
