#include <cstdio>
#include <filesystem>
#include <memory>

#include "base/errors.h"
#include "base/files.h"
#include "commands/commands.h"
#include "commands/set_options.h"
#include "config/data_dir.h"
#include "config/load.h"
#include "mjcf/urdf.h"
#include "run/make_world.h"

namespace understudy::commands {
namespace {

// The command line.
struct ExportArguments : SetArguments {
  std::string robot;
  std::string out;
};

int ExportUrdf(const ExportArguments& arguments) {
  config::Config config = config::LoadConfig({.robot = arguments.robot,
                                              .files = arguments.config_files,
                                              .sets = arguments.sets,
                                              .typed = arguments.typed},
                                             config::DataDir());
  run::MakeWorld(&config);  // which fits the names to those of another's model
  std::map<std::string, mjcf::UrdfLimits> limits;
  for (const robot::MotorSpec* motor : robot::AllMotors(config.robot)) {
    limits[motor->joint] = {.effort = motor->torque_limit, .velocity = motor->no_load_speed};
  }
  const mjcf::ModelHandle model = run::MakeSightModel(config);
  const mjcf::Urdf urdf =
      mjcf::UrdfOf(*model, config.robot.name, mjcf::TreeOf(*model, config.robot.base_body), limits);
  if (arguments.out.empty()) {
    if (!urdf.meshes.empty()) {
      throw ModelError("the robot has meshes, which are separate files: use --out FILE");
    }
    std::fputs(urdf.text.c_str(), stdout);
    return 0;
  }
  const std::filesystem::path out = arguments.out;
  WriteFile(out, urdf.text);
  if (urdf.meshes.empty()) return 0;
  std::error_code ignored;  // told by the first file that cannot be written
  std::filesystem::create_directories(out.parent_path() / "meshes", ignored);
  for (const mjcf::UrdfMesh& mesh : urdf.meshes) {
    WriteFile(out.parent_path() / "meshes" / (mesh.name + ".stl"), mesh.stl);
  }
  return 0;
}

}  // namespace

void AddExportCommand(CLI::App* app, Chosen* chosen) {
  CLI::App* group =
      app->add_subcommand("export", "Write a robot in a format that other programs read");
  group->require_subcommand(1);
  group->footer("Example: understudy export urdf go2 --out go2.urdf");
  const auto arguments = std::make_shared<ExportArguments>();
  CLI::App* urdf = group->add_subcommand("urdf", "Write a robot as URDF, for ROS and viewers");
  urdf->add_option("robot", arguments->robot, "A robot's name or its YAML")
      ->required()
      ->type_name("ROBOT");
  urdf->add_option(
          "--out", arguments->out,
          "File to write; meshes, if there are any, go to meshes/ beside it [standard output]")
      ->type_name("FILE");
  AddShortOption(urdf, arguments.get(), "--revision", "robot.revision", "NAME",
                 "Hardware revision [the robot's default]");
  AddSetOptions(urdf, arguments.get(), "YAML file, as for a run", "robot.model=mine.xml");
  urdf->footer(
      "Links, joints, masses, ranges and frictions are those of the simulated model. Capsules "
      "become\n"
      "a cylinder and two spheres, since URDF has none.\n"
      "Examples:\n"
      "  understudy export urdf go2 --out go2.urdf\n"
      "  understudy export urdf g1 --revision 6 | grep -c '<joint'");
  urdf->callback([=] { *chosen = [=] { return ExportUrdf(*arguments); }; });
}

}  // namespace understudy::commands
