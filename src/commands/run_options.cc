#include "commands/run_options.h"

#include <array>
#include <filesystem>

#include "authority/motion_config.h"
#include "time/pace.h"

namespace understudy::commands {
namespace {

// Options that few runs need; the help lists them last.
constexpr std::array kSeldom = {"--dynamics",     "--no-panel",    "--log-level",
                                "--print-config", "--help-config", "--json"};

}  // namespace

void AddRunOptions(CLI::App* app, RunArguments* arguments) {
  app->add_option(
         "robot", arguments->robots,
         "A robot's name (see `understudy robots`) or its YAML; several, or a YAML file of "
         "several, share a world (docs/reference/several.md)")
      ->required()
      ->type_name("ROBOT");
  // Short forms of --set.
  AddShortOption(app, arguments, "--interface", "network.interface", "NAME",
                 "Network interface [lo]");
  AddShortOption(app, arguments, "--domain", "network.domain", "N", "DDS domain [0]");
  AddShortOption(app, arguments, "--scene", "scene", "NAME|FILE",
                 "Ground: a kind of terrain, MJCF, YAML or a scan [flat]");
  AddShortOption(app, arguments, "--model", "robot.model", "FILE",
                 "MJCF in place of the robot's, with the same joint names")
      ->transform([](const std::string& file) { return std::filesystem::absolute(file).string(); });
  AddShortOption(app, arguments, "--look", "look", "PATH",
                 "Draw the robot by the visual meshes of this copy of unitree_ros or "
                 "unitree_mujoco, or of this MJCF or URDF")
      ->transform([](const std::string& file) { return std::filesystem::absolute(file).string(); });
  AddShortOption(app, arguments, "--revision", "robot.revision", "NAME",
                 "Hardware revision, as `understudy robots` lists them [the robot's default]");
  AddShortOption(
      app, arguments, "--hands", "robot.hand_make", "NAME",
      "Hands, as `understudy robots` lists them: NAME, left:NAME, right:NAME, or none [the "
      "robot's default]");
  AddShortOption(app, arguments, "--dynamics", "robot.dynamics.use", "WHOSE",
                 "Joint friction, damping and armature: catalogue, as in the model's file, or "
                 "fitted to real robots [as the robot's file says; with --model catalogue]");
  AddProfileOption(app, arguments);
  AddShortOption(app, arguments, "--speed", "time.speed", "X",
                 "Simulated seconds per wall second; max = as fast as possible [1]")
      ->transform(CLI::Validator(
          [](std::string& speed) -> std::string {
            double number = 1;
            if (CLI::detail::lexical_cast(speed, number) && number == 0) {
              return std::string("expected ") + time::kSpeedRange + ", found '" + speed + "'";
            }
            if (speed == "max") speed = "0";
            return {};
          },
          ""));
  AddShortOption(app, arguments, "--duration", "time.duration", "S",
                 "Simulated seconds after which the run ends [never]");
  AddShortOption(app, arguments, "--start", "start.pose", "POSE",
                 "lying, standing, hanging or clamped [the robot's default]");
  AddShortOption(app, arguments, "--seed", "randomization.seed", "N",
                 "Seed of randomization [drawn at random, and logged]");
  app->add_flag_callback(
      "--released",
      [arguments] {
        arguments->sets.insert(arguments->sets.begin(),
                               std::string("motion.service=") + authority::kNoService);
      },
      "Start as after ReleaseMode: no motion service is on, rt/lowcmd moves the motors");
  app->add_flag_callback(
      "--no-panel",
      [arguments] { arguments->sets.insert(arguments->sets.begin(), "control.panel=false"); },
      "Serve no panel and open no TCP port; `understudy ctl` still finds the robot");
  app->add_option("--script", arguments->script,
                  "YAML file of timed events: remote controller, crane, pushes")
      ->type_name("FILE");
  CLI::Option* record =
      app->add_option("--record", arguments->record,
                      "Record all topics, the simulation's truth and events to this MCAP file")
          ->type_name("FILE.mcap");
  app->add_flag("--overwrite", arguments->overwrite, "Replace an existing recording")
      ->needs(record);
  AddSetOptions(app, arguments, "YAML file that overrides the robot's", "gate.timeout=0.5");
  app->add_flag("--view", arguments->view,
                "Open a window that shows the robot, as `understudy view` does");
  app->add_option("--name", arguments->name, "Name by which `understudy ctl` finds this robot");
  app->add_option("--log-level", arguments->log_level,
                  "debug, info, warn or error [info; exec: warn]")
      ->check(CLI::IsMember({"debug", "info", "warn", "error"}));
  app->add_flag("--print-config", arguments->print_config,
                "Print the configuration in effect as YAML and exit");
  app->add_flag("--help-config", arguments->help_config, "Print every configuration key and exit");
  app->add_flag("--json", arguments->json, "Log one JSON object per line");
  for (const char* name : kSeldom) app->get_option(name)->group("More options");
}

}  // namespace understudy::commands
