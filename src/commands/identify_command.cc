#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include "base/errors.h"
#include "base/exit_code.h"
#include "base/nearest_word.h"
#include "base/progress_bar.h"
#include "base/signals.h"
#include "bus/participant.h"
#include "commands/commands.h"
#include "commands/set_options.h"
#include "config/data_dir.h"
#include "config/load.h"
#include "config/model_files.h"
#include "ctl/check.h"
#include "identify/excite.h"
#include "identify/identify.h"
#include "physics/bench.h"
#include "record/output_file.h"

namespace understudy::commands {
namespace {

// The command line.
struct IdentifyArguments {
  std::vector<std::string> recordings, parameters;
  std::string robot, out, hold_out = "0.25";
  SetArguments settings;
  double window = identify::Options{}.window;
  int jobs = 0;
  bool by_joint = false, json = false;
};

constexpr int kMostJobs = 64;

// A share, or the files that are held out.
double ShareOf(const IdentifyArguments& arguments) {
  char* end = nullptr;
  const double share = std::strtod(arguments.hold_out.c_str(), &end);
  if (*end != '\0' || arguments.hold_out.empty()) return -1;
  if (share >= 0 && share <= 0.9) return share;
  throw ConfigError("--hold-out " + arguments.hold_out +
                    ": expected a share from 0 to 0.9, or a recording");
}

int IdentifyCommand(const IdentifyArguments& arguments) {
  CatchStopSignals();
  const config::Config config = config::LoadConfig({.robot = arguments.robot,
                                                    .files = arguments.settings.config_files,
                                                    .trees = {},
                                                    .sets = arguments.settings.sets},
                                                   config::DataDir());
  const auto read = [&](const std::string& file) {
    return identify::ReadSamples(file, config.robots[0].spec);
  };
  std::vector<identify::Samples> recordings, held_out;
  std::ranges::transform(arguments.recordings, std::back_inserter(recordings), read);
  const double share = ShareOf(arguments);
  if (share < 0) held_out.push_back(read(arguments.hold_out));

  const config::SceneFile scene("flat", {});
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const identify::Replay replay({.spec = config.robots[0].spec,
                                 .file = config::ModelFile(config.robots[0].spec),
                                 .hands = config::HandModelFiles(config.robots[0].spec)},
                                scene.path(), config.physics.timestep,
                                arguments.jobs > 0 ? arguments.jobs : std::min(cores, kMostJobs));
  const identify::Basis basis(config.robots[0].spec, replay.bench(), arguments.by_joint);
  std::optional<ProgressBar> bar;
  const identify::FitTold told{.line =
                                   [&](const std::string& line) {
                                     bar.reset();  // leaves its line
                                     std::fprintf(stderr, "%s\n", line.c_str());
                                   },
                               .progress =
                                   [&](int done, int most) {
                                     if (!bar) bar.emplace("fit", ProgressOf::kSteps);
                                     bar->Show(done, most);
                                   }};
  const std::optional<identify::Identification> result =
      identify::Identify(replay, basis, recordings, held_out,
                         {.parameters = arguments.parameters,
                          .window = arguments.window,
                          .hold_out = std::max(0.0, share)},
                         told);
  bar.reset();
  if (!result) {
    std::fputs("stopped before the fit was finished\n", stderr);
    return 128 + StopSignal();
  }
  const std::string text = arguments.json ? identify::ResultJson(*result, recordings)
                                          : identify::ResultText(*result, recordings);
  std::fputs(text.c_str(), stdout);
  if (arguments.out.empty()) return 0;
  record::OutputFile(arguments.out, true)
      .Write(record::AsBytes(identify::ResultYaml(*result, basis, recordings)));
  if (!arguments.json) {
    std::printf("\n%s\nnext: understudy run %s --config %s\n", arguments.out.c_str(),
                arguments.robot.c_str(), arguments.out.c_str());
  }
  return 0;
}

struct ExciteArguments {
  std::string robot;
  std::vector<std::string> joints;
  identify::ExciteSettings settings;
};

// "FR_hip_joint" is FR_hip.
std::string ShortName(const std::string& joint) {
  constexpr std::string_view kEnd = "_joint";
  return joint.ends_with(kEnd) ? joint.substr(0, joint.size() - kEnd.size()) : joint;
}

std::vector<std::size_t> MotorsOf(const robot::RobotSpec& robot,
                                  const std::vector<std::string>& joints) {
  std::vector<std::size_t> motors;
  std::vector<std::string> names;
  for (const robot::MotorSpec& motor : robot.motors) names.push_back(ShortName(motor.joint));
  for (const std::string& joint : joints) {
    const auto found = std::ranges::find(names, ShortName(joint));
    if (found == names.end()) {
      throw ConfigError("--joints: no joint '" + joint + "'" + DidYouMean(ShortName(joint), names));
    }
    motors.push_back(static_cast<std::size_t>(found - names.begin()));
  }
  return motors;
}

int ExciteCommand(ExciteArguments arguments) {
  CatchStopSignals();
  const config::Config config = config::LoadConfig(
      {.robot = arguments.robot, .files = {}, .trees = {}, .sets = {}}, config::DataDir());
  arguments.settings.excitation.motors = MotorsOf(config.robots[0].spec, arguments.joints);
  const config::SceneFile scene("flat", {});
  const physics::Bench bench({.spec = config.robots[0].spec,
                              .file = config::ModelFile(config.robots[0].spec),
                              .hands = config::HandModelFiles(config.robots[0].spec)},
                             scene.path(), config.physics.timestep);
  std::optional<ProgressBar> bar(std::in_place, "excite");
  const identify::ExciteEnd end = identify::Excite(
      config.robots[0].spec, bench, arguments.settings,
      [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); },
      [&](double done, double whole) { bar->Show(done, whole); });
  bar.reset();  // leaves its line
  if (end == identify::ExciteEnd::kDone) return 0;
  if (end == identify::ExciteEnd::kStopped) {
    std::fputs("stopped; the joints are damped\n", stderr);
    return 128 + StopSignal();
  }
  std::fputs(
      "a joint is 0.6 rad away from its target: is something in its way, or is kp too low? The "
      "joints are damped\n",
      stderr);
  return static_cast<int>(ExitCode::kInternal);
}

}  // namespace

void AddExciteCommand(CLI::App* app, Chosen* chosen) {
  const auto arguments = std::make_shared<ExciteArguments>();
  identify::ExciteSettings& settings = arguments->settings;
  identify::ExcitationSpec& law = settings.excitation;
  CLI::App* excite =
      app->add_subcommand("excite", "Move the joints of a robot on a stand, to identify them");
  excite->add_option("--robot", arguments->robot, "The robot: a name or a YAML file")
      ->required()
      ->type_name("ROBOT");
  excite
      ->add_option("--network-interface", settings.interface,
                   "Network interface that leads to the robot [lo]")
      ->type_name("NAME");
  excite->add_option("--domain", settings.domain, "DDS domain [0]")
      ->type_name("N")
      ->check(CLI::Range(0, bus::kLastDomain));
  excite->add_option("--joints", arguments->joints, "Joints to move, separated by commas [all]")
      ->delimiter(',')
      ->type_name("NAMES");
  const auto number = [&](const char* name, double* value, const char* help, double least,
                          double most, const char* unit) {
    excite->add_option(name, *value, help)->type_name(unit)->check(ctl::NumberWithin(least, most));
  };
  number("--amplitude", &law.amplitude,
         "Amplitude, rad; less where the range of a joint is too small [0.3]", 0.01, 1.5, "RAD");
  number("--from-hz", &law.from_hz, "Frequency at which the chirps begin, Hz [0.2]", 0.05, 50,
         "HZ");
  number("--to-hz", &law.to_hz, "Frequency at which they end, Hz [6]", 0.05, 50, "HZ");
  number("--seconds", &law.seconds, "How long they last, s [20]", 2, 600, "S");
  number("--kp", &law.kp, "N·m/rad [20]", 0.1, 500, "KP");
  number("--kd", &law.kd, "N·m·s/rad [1]", 0, 50, "KD");
  excite->add_flag(
      "--on-a-real-robot", settings.on_a_real_robot,
      "Confirms that it is a real robot on a stand, and that nobody is within its reach");
  excite->footer(
      "Sends rt/lowcmd at 500 Hz: a move to the hanging pose, chirps about it, and damping\n"
      "that sets in gently, also at Ctrl-C. Refuses while somebody else commands the motors,\n"
      "while a motion service moves them, and where the feet carry the robot. Record the robot\n"
      "meanwhile.\n"
      "Examples:\n"
      "  understudy run go2 --start clamped --released --record chirp.mcap\n"
      "  understudy excite --robot go2\n"
      "  understudy excite --robot go2 --network-interface eth0 --on-a-real-robot --joints "
      "FR_calf");
  excite->callback([=] { *chosen = [=] { return ExciteCommand(*arguments); }; });
}

void AddIdentifyCommand(CLI::App* app, Chosen* chosen) {
  const auto arguments = std::make_shared<IdentifyArguments>();
  CLI::App* identify =
      app->add_subcommand("identify", "Fit a robot's joints to recordings of a real one");
  identify
      ->add_option("recordings", arguments->recordings,
                   "Recordings of the robot on a stand, MCAP or CSV")
      ->required()
      ->type_name("RECORDING...");
  identify->add_option("--robot", arguments->robot, "The robot: a name or a YAML file")
      ->required()
      ->type_name("ROBOT");
  identify
      ->add_option(
          "--hold-out", arguments->hold_out,
          "Share of the windows, or a recording, that judges the fit and has no part in it "
          "[0.25]")
      ->type_name("SHARE|FILE");
  identify
      ->add_option("--parameters", arguments->parameters,
                   "What to fit, separated by commas: armature, damping, frictionloss, kd_share, "
                   "kp_scale, mass, delay [armature,damping,frictionloss,delay]")
      ->delimiter(',')
      ->type_name("NAMES");
  identify->add_flag("--by-joint", arguments->by_joint,
                     "Fit figures for each joint alone [the joints in a row of "
                     "robot.dynamics.fitted share theirs]");
  identify
      ->add_option("--window", arguments->window,
                   "Time that is simulated from one measured state, s [0.2]")
      ->type_name("S")
      ->check(ctl::NumberWithin(0.02, 10));
  identify->add_option("--jobs", arguments->jobs, "Threads [one per core]")
      ->type_name("N")
      ->check(CLI::Range(1, kMostJobs));
  AddSetOptions(identify, &arguments->settings, "Settings to begin with, as for `run`",
                "robot.dynamics.delay=0.002");
  identify
      ->add_option(
          "--out", arguments->out,
          "YAML to write, for --config of the other commands; an existing one is replaced [none]")
      ->type_name("FILE");
  identify->add_flag("--json", arguments->json, "Print one JSON document");
  identify->footer(
      "Simulates short windows from measured states with the recorded commands (rt/lowcmd),\n"
      "and searches for figures with which the joints move as recorded. Figures that the data\n"
      "leave open are named and not changed. A CSV has the columns time, JOINT.q, JOINT.q_des,\n"
      "JOINT.dq_des, JOINT.kp, JOINT.kd, JOINT.tau_ff. More: docs/reference/identify.md.\n"
      "Examples:\n"
      "  understudy identify chirp.mcap --robot go2 --out mine.yaml\n"
      "  understudy identify a.mcap b.mcap --robot go2 --hold-out c.mcap --by-joint\n"
      "  understudy run go2 --config mine.yaml");
  identify->callback([=] { *chosen = [=] { return IdentifyCommand(*arguments); }; });
}

}  // namespace understudy::commands
