#include <cstdio>
#include <filesystem>
#include <memory>

#include "assembly/make_world.h"
#include "base/errors.h"
#include "base/files.h"
#include "commands/commands.h"
#include "commands/mjlab_package.h"
#include "commands/set_options.h"
#include "config/data_dir.h"
#include "config/load.h"
#include "mjcf/saved_model.h"
#include "mjcf/urdf.h"
#include "physics/world_model.h"
#include "run/log_notes.h"

namespace understudy::commands {
namespace {

// The command line.
struct ExportArguments : SetArguments {
  std::string robot;
  std::string out;
  std::string definition;  // of mjlab's policy
};

config::Config ConfigOf(const ExportArguments& arguments) {
  return config::LoadConfig({.robot = arguments.robot,
                             .files = arguments.config_files,
                             .sets = arguments.sets,
                             .typed = arguments.typed},
                            config::DataDir());
}

int ExportMjcf(const ExportArguments& arguments) {
  config::Config config = ConfigOf(arguments);
  const assembly::MadePhysics made = assembly::MakePhysics(&config);
  run::LogNotes(made.notes);
  const mjcf::SavedModel saved = mjcf::SaveModel(made.world.robot().model(), physics::kClampName);
  if (arguments.out.empty()) {
    if (!saved.fields.empty()) {
      throw ModelError("the ground is a height field, which is a separate file: use --out FILE");
    }
    std::fputs(saved.xml.c_str(), stdout);
    return 0;
  }
  const std::filesystem::path out = arguments.out;
  WriteFile(out, saved.xml);
  for (const mjcf::SavedField& field : saved.fields) {
    WriteFile(out.parent_path() / field.file, field.bytes);
  }
  return 0;
}

int ExportMjlab(const ExportArguments& arguments) {
  const std::vector<std::string> left_out =
      WriteMjlabPackage(ConfigOf(arguments), arguments.out, arguments.definition);
  for (const std::string& key : left_out) {
    std::fprintf(stderr, "randomization.%s is not drawn by mjlab\n", key.c_str());
  }
  return 0;
}

int ExportUrdf(const ExportArguments& arguments) {
  config::Config config = ConfigOf(arguments);
  // This fits the names to those of another's model.
  const assembly::MadePhysics made = assembly::MakePhysics(&config);
  run::LogNotes(made.notes);
  std::map<std::string, mjcf::UrdfLimits> limits;
  for (const robot::MotorSpec* motor : robot::AllMotors(config.robots[0].spec)) {
    limits[motor->joint] = {.effort = motor->torque_limit, .velocity = motor->no_load_speed};
  }
  const std::shared_ptr<const mjModel> model = made.sight->Get();
  const auto urdf_with = [&](mjcf::MeshUse use) {
    const std::string& base = config.robots[0].spec.base_body;
    return mjcf::UrdfOf(*model, config.robots[0].spec.name, mjcf::TreeOf(*model, base), limits,
                        use);
  };
  const mjcf::Urdf urdf = urdf_with(mjcf::MeshUse::kFiles);
  if (arguments.out.empty()) {
    if (!urdf.meshes.empty()) {
      std::fputs("meshes are cylinders and boxes here; --out FILE writes them beside FILE\n",
                 stderr);
    }
    std::fputs(urdf_with(mjcf::MeshUse::kPrimitives).text.c_str(), stdout);
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

CLI::App* AddFormat(CLI::App* group, ExportArguments* arguments, const std::string& format,
                    const std::string& about, const std::string& out) {
  CLI::App* app = group->add_subcommand(format, about);
  app->add_option("robot", arguments->robot, "A robot's name or its YAML")
      ->required()
      ->type_name("ROBOT");
  app->add_option("--out", arguments->out, out)->type_name("FILE");
  AddShortOption(app, arguments, "--revision", "robot.revision", "NAME",
                 "Hardware revision [the robot's default]");
  AddShortOption(app, arguments, "--hands", "robot.hand_make", "NAME",
                 "Hands: NAME, left:NAME, right:NAME, or none [the robot's default]");
  return app;
}

}  // namespace

void AddExportCommand(CLI::App* app, Chosen* chosen) {
  CLI::App* group =
      app->add_subcommand("export", "Write a robot in a format that other programs read");
  group->require_subcommand(1);
  group->footer("Example: understudy export urdf go2 --out go2.urdf");
  const auto arguments = std::make_shared<ExportArguments>();
  CLI::App* urdf = AddFormat(
      group, arguments.get(), "urdf", "Write a robot as URDF, for ROS and viewers",
      "File to write; meshes, if there are any, go to meshes/ beside it [standard output]");
  AddSetOptions(urdf, arguments.get(), "YAML file, as for a run", "robot.model=mine.xml");
  urdf->footer(
      "Links, joints, masses, ranges and frictions are those of the simulated model. Capsules "
      "become\n"
      "a cylinder and two spheres, since URDF has none.\n"
      "Examples:\n"
      "  understudy export urdf go2 --out go2.urdf\n"
      "  understudy export urdf g1 --revision 6 | grep -c '<joint'");
  urdf->callback([=] { *chosen = [=] { return ExportUrdf(*arguments); }; });
  CLI::App* mjcf =
      AddFormat(group, arguments.get(), "mjcf", "Write a robot and its ground as MJCF, for MuJoCo",
                "File to write; height fields, if there are any, go beside it [standard output]");
  AddShortOption(mjcf, arguments.get(), "--scene", "scene", "NAME|FILE",
                 "Ground: a kind of terrain, MJCF or YAML [flat]");
  AddSetOptions(mjcf, arguments.get(), "YAML file, as for a run", "terrain.difficulty=0.7");
  mjcf->footer(
      "The very model that is simulated, revisions, fitted joints and drawn values included, in "
      "one\n"
      "file that MuJoCo 2 and 3 load. Its actuators are torques [N·m]; motor curves, heat, delay\n"
      "and sensors are Understudy's own and are not in it.\n"
      "Examples:\n"
      "  understudy export mjcf g1 --out g1.xml\n"
      "  understudy export mjcf go2 --scene rough --out go2.xml");
  mjcf->callback([=] { *chosen = [=] { return ExportMjcf(*arguments); }; });
  CLI::App* mjlab = AddFormat(group, arguments.get(), "mjlab",
                              "Write a robot as a task of mjlab, to train on a graphics card",
                              "Folder to write, by the name of a Python package");
  mjlab->get_option("--out")->required()->type_name("FOLDER");
  mjlab
      ->add_option("--definition", arguments->definition,
                   "deploy.yaml of the policy [the robot's own gains and pose]")
      ->type_name("FILE")
      ->check(CLI::ExistingFile);
  AddSetOptions(mjlab, arguments.get(), "YAML file, as for a run", "randomization.mass=0.9,1.1");
  mjlab->footer(
      "The very model that is simulated, its motors, delay and noise, and what the configuration\n"
      "draws at random, which mjlab then draws for each of its worlds. It walks by velocity on\n"
      "flat ground. Put the parent folder on PYTHONPATH; `python -m go2_lab train` trains.\n"
      "Examples:\n"
      "  understudy export mjlab go2 --out go2_lab\n"
      "  understudy export mjlab g1 --config randomization.yaml --out g1_lab");
  mjlab->callback([=] { *chosen = [=] { return ExportMjlab(*arguments); }; });
}

}  // namespace understudy::commands
