// Walks robots over all sorts of ground, pushes them and counts who keeps on their feet: the tables
// of docs/dev/walking.md.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <set>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <spdlog/spdlog.h>

#include "config/data_dir.h"
#include "config/load.h"
#include "config/robot_file.h"
#include "tests/motion/humanoid/trial.h"
#include "tests/motion/quadruped/trial.h"

namespace understudy::motion {
namespace {

robot::RobotSpec SpecOf(const std::string& robot) {
  return config::LoadConfig({.robot = robot, .files = {}, .sets = {}}, config::DataDir())
      .robots[0]
      .spec;
}

// How robots of one build are tried.
struct Course {
  std::span<const TrialGround> grounds;
  Outcome (*run)(const Trial& trial, const Watch& watch);
  double (*push)(const robot::RobotSpec& spec, const std::string& ground);
};

Course CourseOf(const robot::RobotSpec& spec) {
  if (spec.kind == robot::RobotKind::kHumanoid) {
    return {HumanoidGrounds(), TryHumanoid, [](const robot::RobotSpec&, const std::string& ground) {
              return HumanoidPush(ground);
            }};
  }
  return {TrialGrounds(), Try, [](const robot::RobotSpec& quadruped, const std::string& ground) {
            return ground == "stairs" ? 0 : PushOf(quadruped);
          }};
}

// The first seed that follows from the version counted: FNV-1a of 30 bits.
int SeedOf(const std::string& version) {
  std::uint32_t hash = 2166136261;
  for (const char c : version) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619;
  return static_cast<int>((hash >> 30 ^ hash) & 0x3fffffff);
}

// Runs that were made, a line of a file each, so that a table broken off goes on where it was.
class Made {
 public:
  // "": kept in memory only.
  explicit Made(const std::string& file) : file_(file) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
      std::istringstream words(line);
      Trial trial;
      Outcome outcome;
      if (words >> trial.robot >> trial.ground >> trial.push >> trial.seed >> outcome.fell >>
          outcome.righted >> outcome.got_there) {
        std::getline(words >> std::ws, trial.policy);
        made_[KeyOf(trial)] = outcome;
      }
    }
  }

  Outcome Of(const Trial& trial, const Course& course) {
    const auto found = made_.find(KeyOf(trial));
    if (found != made_.end()) return found->second;
    const Outcome outcome = made_[KeyOf(trial)] = course.run(trial, {});
    if (!file_.empty()) {
      std::ofstream(file_, std::ios::app)
          << trial.robot << ' ' << trial.ground << ' ' << trial.push << ' ' << trial.seed << ' '
          << outcome.fell << ' ' << outcome.righted << ' ' << outcome.got_there
          << (trial.policy.empty() ? "" : " ") << trial.policy << '\n';
    }
    return outcome;
  }

 private:
  using Key = std::tuple<std::string, std::string, double, int, std::string>;
  static Key KeyOf(const Trial& trial) {
    return {trial.robot, trial.ground, trial.push, trial.seed, trial.policy};
  }

  std::string file_;
  std::map<Key, Outcome> made_;
};

struct Interval {
  double low, high;
};

// Of a share of `n` that was seen `k` times, with 95 %: Wilson, Journal of the American Statistical
// Association 22 (1927).
Interval Wilson(int k, int n) {
  constexpr double kZ = 1.959964;
  const double share = static_cast<double>(k) / n, z2n = kZ * kZ / n;
  const double middle = (share + z2n / 2) / (1 + z2n);
  const double half = kZ * std::sqrt(share * (1 - share) / n + z2n / (4 * n)) / (1 + z2n);
  return {middle - half, middle + half};
}

void PrintRow(Trial trial, const Course& course, int first, int runs, Made* made) {
  int kept = 0, there = 0, righted = 0;
  std::string failed;
  for (int seed = first; seed < first + runs; ++seed) {
    trial.seed = seed;
    const Outcome outcome = made->Of(trial, course);
    kept += outcome.fell < 0;
    there += outcome.fell < 0 && outcome.got_there;
    righted += outcome.fell >= 0 && outcome.righted;
    if (outcome.fell >= 0 || !outcome.got_there) failed += " " + std::to_string(seed);
  }
  const Interval interval = Wilson(kept, runs);
  std::printf("| %-5s | %-6s | %4.2f | %d of %d | %.1f %% to %.1f %% | %d | %d of %d |%s\n",
              trial.robot.c_str(), trial.ground.c_str(), trial.push, kept, runs, 100 * interval.low,
              100 * interval.high, kept - there, righted, runs - kept, failed.c_str());
  std::fflush(stdout);
}

void PrintState(const MotionRig& rig, double t, const Eigen::Vector3d& wish) {
  const Eigen::Vector3d rpy = rig.rpy(), p = rig.world().robot().base().p_WB;
  const Eigen::Vector3d v = rig.world().robot().base().v_WB_W;
  const robot::MotionState state = rig.state();
  std::printf(
      "%6.2f %5d  p %6.2f %6.2f %5.2f  rpy %5.2f %5.2f %5.2f  height %5.3f  v %5.2f %5.2f (%5.2f "
      "%5.2f)  asked %5.2f %5.2f %5.2f\n",
      t, state.id, p.x(), p.y(), p.z(), rpy.x(), rpy.y(), rpy.z(), state.body_height,
      state.v_WB_W.x(), state.v_WB_W.y(), v.x(), v.y(), wish.x(), wish.y(), wish.z());
}

int Main(int argc, char** argv) {
  std::string about = "Counts how many of some seeded runs a robot keeps on its feet. Grounds:\n";
  std::vector<std::string> robots, grounds;
  std::set<std::string> known;
  for (const auto& [legs, course] :
       {std::pair("four", TrialGrounds()), std::pair("two", HumanoidGrounds())}) {
    about += std::string(" of ") + legs + " legs:\n";
    for (const TrialGround& ground : course) {
      known.insert(ground.name);
      about += "  " + ground.name + std::string(8 - ground.name.size(), ' ') + ground.about + "\n";
    }
  }
  CLI::App app(about + "The last number of a row: the seeds that fell or did not get there.",
               "survival");
  double push = -1;
  int runs = 40, first = 1, trace = 0;
  std::string file, version, policy;
  app.add_option("--robots", robots, "Robots [all quadrupeds]")->delimiter(',');
  app.add_option("--grounds", grounds, "Grounds [all]")
      ->delimiter(',')
      ->check(CLI::IsMember(known));
  app.add_option("--push", push,
                 "N·s/kg [1; B2 and A2 0.9, on wheels 0.6; stairs 0; humanoids 0.3, aside two "
                 "thirds of it, on flat ground, else 0]");
  app.add_option("--runs", runs, "Runs of a row")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  auto* const from =
      app.add_option("--first", first, "Seed of the first run")->capture_default_str();
  app.add_option("--version", version,
                 "The version counted: the first seed is its hash, and nobody's choice. For "
                 "humanoids `git rev-parse HEAD:src/motion/humanoid`")
      ->excludes(from);
  app.add_option("--policy", policy, "A deploy.yaml that walks the quadrupeds in place of the trot")
      ->check(CLI::ExistingFile);
  app.add_option("--file", file, "Keeps every run there, and goes on from what it has");
  app.add_option("--trace", trace,
                 "Shows the run of that seed, every 20 ms, in place of the table");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (!version.empty()) first = SeedOf(version);
  if (robots.empty()) {
    for (const std::string& name : config::RobotNames(config::DataDir())) {
      if (robot::IsQuadruped(SpecOf(name).kind)) robots.push_back(name);
    }
  }
  spdlog::set_level(trace == 0 ? spdlog::level::warn : spdlog::level::info);
  Made made(file);
  if (trace == 0) {
    std::printf(
        "seeds from %d\n| robot | ground | N·s/kg | kept on its feet | 95 %% | stuck | righted "
        "|\n|---|---|---|---|---|---|---|\n",
        first);
  }
  for (const std::string& robot : robots) {
    const robot::RobotSpec spec = SpecOf(robot);
    if (!policy.empty() && !robot::IsQuadruped(spec.kind)) {
      throw std::invalid_argument(robot + ": --policy walks quadrupeds only");
    }
    const Course course = CourseOf(spec);
    for (const TrialGround& ground : course.grounds) {
      if (!grounds.empty() && std::ranges::count(grounds, ground.name) == 0) continue;
      const Trial trial{robot, ground.name, push < 0 ? course.push(spec, ground.name) : push, trace,
                        policy};
      if (trace == 0) {
        PrintRow(trial, course, first, runs, &made);
      } else {
        const Outcome outcome = course.run(trial, PrintState);
        std::printf("fell %.2f, righted %d, got there %d\n", outcome.fell, outcome.righted,
                    outcome.got_there);
      }
    }
  }
  return 0;
}

}  // namespace
}  // namespace understudy::motion

int main(int argc, char** argv) {
  try {
    return understudy::motion::Main(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "survival: %s\n", error.what());
    return 1;
  }
}
