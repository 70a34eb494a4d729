#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

#include "base/errors.h"
#include "base/exit_code.h"
#include "base/files.h"
#include "commands/commands.h"
#include "config/data_dir.h"
#include "config/load.h"
#include "config/model_files.h"
#include "config/new_robot.h"
#include "config/robot_file.h"
#include "physics/world_model.h"

namespace understudy::commands {
namespace {

namespace fs = std::filesystem;

// The command line.
struct NewArguments {
  std::string folder;
  std::string urdf;
  std::string like;
};

// The model's comment; XML allows no "--" in it.
std::string ModelComment(const config::NewRobot& robot) {
  return " " + robot.name +
         ", made by `understudy new`. No part of it meets another: conaffinity 1 " +
         "lets them.\n       Assumed: armature, the rotors' inertia, kg m2; friction of the "
         "ground " +
         "is MuJoCo's default. Lengths m, masses kg. ";
}

void MakeRobotFolder(const fs::path& folder) {
  const std::string name = folder.filename();
  if (name.empty() || name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                             "0123456789_") != std::string::npos) {
    throw ConfigError("'" + folder.string() +
                      "': expected a folder whose name is the robot's: letters, digits, _");
  }
  std::error_code error;
  if (fs::exists(folder, error)) {
    throw ConfigError(folder.string() + ": is there already; choose another name, or remove it");
  }
  fs::create_directories(folder, error);
  if (error) throw ConfigError(folder.string() + ": cannot be made: " + error.message());
}

void CopyMeshes(const std::vector<mjcf::UrdfReadMesh>& meshes, const fs::path& folder) {
  std::error_code error;
  for (const mjcf::UrdfReadMesh& mesh : meshes) {
    const fs::path to = folder / mesh.to;
    fs::create_directories(to.parent_path(), error);
    if (!mesh.stl.empty()) {
      WriteFile(to, mesh.stl);
      continue;
    }
    if (fs::copy_file(mesh.from, to, error); error) {
      throw ConfigError(to.string() + ": cannot be written: " + error.message());
    }
  }
}

// Whether the robot can bear all hands that `like` can. Throws ModelError if a hand's model cannot
// be read.
bool KeepsHands(const mjcf::UrdfRobot& robot, const std::string& like,
                const std::vector<std::string>& makes) {
  return !makes.empty() && std::ranges::all_of(makes, [&](const std::string& make) {
    const config::Config with = config::LoadConfig(
        {.robot = like, .files = {}, .trees = {}, .sets = {"robot.hand_make=" + make}},
        config::DataDir());
    return config::HasWrists(robot, config::HandModelFiles(with.robots[0].spec));
  });
}

// What drives what. `like` is the other robot. Returns how many motors have no joint.
int PrintMotors(const config::NewRobot& robot, const robot::RobotSpec& like) {
  int missing = 0;
  std::vector<std::string> driven;
  for (const robot::HandSpec& hand : like.hands) {
    for (const robot::MotorSpec& motor : hand.motors) driven.push_back(motor.joint);
  }
  std::printf("%-28s slot  joint of %s\n", ("motor of " + robot.like).c_str(), robot.urdf.c_str());
  for (const config::MotorMatch& match : robot.motors) {
    std::string joint = match.joint;
    if (joint.empty()) {
      ++missing;
      joint = "MISSING";
      for (std::size_t i = 0; i < match.near.size(); ++i) {
        joint += (i == 0 ? "; perhaps " : ", ") + match.near[i];
      }
    }
    driven.push_back(match.joint);
    std::printf("%-28s %4d  %s\n", match.motor.c_str(), match.slot, joint.c_str());
  }
  for (const mjcf::UrdfReadJoint& joint : robot.robot.joints) {
    if (std::ranges::find(driven, joint.name) == driven.end()) {
      std::printf("note: no motor drives joint '%s'\n", joint.name.c_str());
    }
  }
  if (robot.keeps_hands) {
    std::string makes;
    for (const std::string& make : like.hand_makes) makes += (makes.empty() ? "" : ", ") + make;
    std::printf("it can bear hands, as %s can: --hands %s\n", robot.like.c_str(), makes.c_str());
  }
  for (const std::string& note : robot.robot.notes) std::printf("note: %s\n", note.c_str());
  return missing;
}

// Throws ConfigError or ModelError for what `understudy check` would.
void CheckThatItFits(const fs::path& yaml) {
  const config::Config config = config::LoadConfig(
      {.robot = yaml.string(), .files = {}, .trees = {}, .sets = {}}, config::DataDir());
  const config::SceneFile scene("flat", {});
  physics::LoadWorldModel({{.spec = config.robots[0].spec,
                            .file = config::ModelFile(config.robots[0].spec),
                            .hands = config::HandModelFiles(config.robots[0].spec)}},
                          scene.path(), config.physics.timestep);
}

int NewCommand(const NewArguments& arguments) {
  const config::Config like =
      config::LoadConfig({.robot = arguments.like, .files = {}, .sets = {}}, config::DataDir());
  const std::vector<std::string> revisions =
      config::ReadRobotFile(arguments.like, config::DataDir()).RevisionNames();
  const bool is_file = arguments.like.find('/') != std::string::npos ||
                       fs::path(arguments.like).extension() == ".yaml";
  const std::string like_name =
      is_file ? fs::absolute(arguments.like).lexically_normal().string() : arguments.like;
  const fs::path folder = (fs::path(arguments.folder) / "").parent_path();  // also of "mydog/"
  config::NewRobot robot{.name = folder.filename(),
                         .like = like_name,
                         .urdf = arguments.urdf,
                         .robot = mjcf::ReadUrdf(arguments.urdf),
                         .motors = {},
                         .two_units = false,
                         .keeps_hands = false};
  robot.motors = config::MatchMotors(like.robots[0].spec, robot.robot.joints);
  const std::array<std::string, 2> units = config::AddImuSites(like.robots[0].spec, &robot.robot);
  robot.two_units = !units[1].empty();
  robot.keeps_hands = KeepsHands(robot.robot, arguments.like, like.robots[0].spec.hand_makes);
  robot.robot.model.Set("model", robot.name);

  MakeRobotFolder(folder);
  const fs::path model = folder / (robot.name + ".xml"), yaml = folder / (robot.name + ".yaml");
  const fs::path scenario = folder / "starts.yaml";
  try {
    CopyMeshes(robot.robot.meshes, folder);
    WriteFile(model, mjcf::IndentedMjcf(robot.robot.model, ModelComment(robot)));
    const mjcf::ModelHandle compiled = physics::LoadModelFile(model);
    WriteFile(yaml, config::NewRobotYaml(robot, like.robots[0].spec, *compiled, revisions));
    WriteFile(scenario,
              config::NewScenarioYaml(robot, like.robots[0].spec, *compiled, yaml.filename()));
  } catch (const SetupError&) {
    std::error_code ignored;
    fs::remove_all(folder, ignored);  // which was not there before
    throw;
  }

  std::printf("%s: %zu links, %zu joints; base %s; inertial unit at the origin of %s%s\n",
              model.c_str(), robot.robot.bodies.size(), robot.robot.joints.size(),
              robot.robot.base.c_str(), units[0].c_str(),
              robot.two_units ? (", a second one of " + units[1]).c_str() : "");
  std::printf("%s: a robot like %s\n%s: a first scenario\n\n", yaml.c_str(), robot.like.c_str(),
              scenario.c_str());
  const int missing = PrintMotors(robot, like.robots[0].spec);
  if (missing > 0) {
    const bool few = 2 * static_cast<std::size_t>(missing) < robot.motors.size();
    std::printf("\n%d of %zu motors have no joint: name them in %s, then: understudy check %s%s\n",
                missing, robot.motors.size(), yaml.c_str(), yaml.c_str(),
                few ? "; a run leaves out those that the robot does not have" : "");
    return static_cast<int>(ExitCode::kConfig);
  }
  CheckThatItFits(yaml);
  std::printf("\nnext: understudy check %s; understudy run %s; understudy rehearse %s\n",
              yaml.c_str(), yaml.c_str(), scenario.c_str());
  return 0;
}

}  // namespace

void AddNewCommand(CLI::App* app, Chosen* chosen) {
  const auto arguments = std::make_shared<NewArguments>();
  CLI::App* command = app->add_subcommand("new", "Make a robot of your own from its URDF");
  command->add_option("folder", arguments->folder, "Folder to make; its name is the robot's")
      ->required()
      ->type_name("FOLDER");
  command->add_option("--urdf", arguments->urdf, "The robot's URDF, with its meshes beside it")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("--like", arguments->like,
                   "Robot whose messages, motors, services and gains it has: a name or a YAML file")
      ->required()
      ->type_name("ROBOT");
  command->footer(
      "Writes FOLDER/NAME.xml, the model; FOLDER/NAME.yaml, the robot, every key explained; and\n"
      "FOLDER/starts.yaml, a first scenario. Says which joint each motor drives: one of the same\n"
      "name, or that differs by case, underlines, `joint`, or usual words (front_right, FR).\n"
      "Examples:\n"
      "  understudy new mydog --urdf my.urdf --like go2\n"
      "  understudy run mydog/mydog.yaml\n"
      "Exits with 3 if a motor has no joint: the files are there, and the line to change says\n"
      "MISSING; with 4 if the URDF cannot be used.");
  command->callback([=] { *chosen = [=] { return NewCommand(*arguments); }; });
}

}  // namespace understudy::commands
