#include "assembly/make_world.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <random>
#include <utility>

#include <malloc.h>

#include "authority/onboard.h"
#include "base/errors.h"
#include "base/printed.h"
#include "config/load.h"
#include "config/model_files.h"
#include "config/randomization_keys.h"
#include "mjcf/join.h"
#include "mjcf/randomize_model.h"
#include "motion/controllers.h"
#include "physics/contacts.h"
#include "physics/world_model.h"

namespace understudy::assembly {
namespace {

using enum Note::Level;
using Notes = std::vector<Note>;

void Add(physics::LoadNotes loaded, Notes* notes) {
  for (std::string& warning : loaded.warnings) notes->push_back({kWarning, std::move(warning)});
  if (!loaded.rewrites.empty()) {
    notes->push_back({kInfo, std::to_string(loaded.rewrites.size()) +
                                 " places of the model were rewritten for this MuJoCo "
                                 "(`understudy check` lists them)"});
  }
  for (const mjcf::Rewrite& rewrite : loaded.rewrites) notes->push_back({kDebug, rewrite.text()});
  for (std::string& looks : loaded.looks) notes->push_back({kDebug, std::move(looks)});
}

// Adds a line per quantity, to four digits.
void Add(const robot::Draws& draws, Notes* notes) {
  std::map<std::string, std::string> lines;
  for (const robot::Drawn& drawn : draws.values) {
    std::string& line = lines[drawn.quantity];
    if (!line.empty()) line += ", ";
    line += (drawn.element.empty() ? "" : drawn.element + " ") + Printed("%.4g", drawn.value);
  }
  for (const auto& [quantity, line] : lines) {
    notes->push_back({kInfo, "drawn " + quantity + ": " + line});
  }
}

int SeedOf(const robot::RandomizationSpec& randomization, Notes* notes) {
  if (randomization.seed >= 0) {
    notes->push_back({kInfo, "randomized from seed " + std::to_string(randomization.seed)});
    return randomization.seed;
  }
  const int seed = static_cast<int>(std::random_device()() & 0x7fffffffU);
  const std::string text = std::to_string(seed);
  notes->push_back({kWarning, "randomized from seed " + text + ", drawn for this run: --seed " +
                                  text + " repeats it"});
  return seed;
}

bool IsThirdParty(const config::RobotConfig& robot) {
  return !std::filesystem::path(robot.spec.model).is_relative();
}

struct Loaded {
  mjcf::ModelHandle model;
  std::shared_ptr<const terrain::Scan> scan;  // null: the scene is none
};

// A third-party model may have other names than the robot's description, which then takes them.
Loaded LoadModel(config::Config* config, Notes* notes) {
  const config::SceneFile scene(config->scene, config->terrain);
  const physics::Surroundings around(scene.path(), config->objects);
  const double timestep = config->physics.timestep;
  physics::LoadNotes loaded;
  mjcf::ModelHandle model;
  for (config::RobotConfig& robot : config->robots) {
    if (!IsThirdParty(robot)) continue;
    physics::FittedModel fitted =
        physics::LoadFittedModel({.spec = robot.spec,
                                  .file = config::ModelFile(robot.spec),
                                  .hands = config::HandModelFiles(robot.spec),
                                  .x = robot.start.at[0],
                                  .y = robot.start.at[1],
                                  .yaw = robot.start.at[2]},
                                 around, timestep, &loaded);
    robot.spec = std::move(fitted.spec);
    if (config->robots.size() == 1) model = std::move(fitted.model);
  }
  if (model == nullptr) {
    model = physics::LoadWorldModel(PlacedRobots(*config), around, timestep, &loaded);
  }
  if (config->physics.contacts == config::ContactModel::kPyramid) physics::UsePyramids(model.get());
  malloc_trim(0);  // compiling needs many times the memory of the result, which may be locked later
  Add(std::move(loaded), notes);
  return {std::move(model), scene.scan()};
}

// Returns LoadModel's result, or a copy of what `reused` has for this time step.
Loaded LoadOrCopyModel(config::Config* config, Reused* reused, Notes* notes) {
  if (reused == nullptr) return LoadModel(config, notes);
  std::shared_ptr<const CompiledModel>& kept = reused->models[config->physics.timestep];
  if (kept == nullptr) {
    auto made = std::make_shared<CompiledModel>();
    Loaded loaded = LoadModel(config, &made->notes);
    made->model = std::move(loaded.model);
    made->scan = std::move(loaded.scan);
    for (const config::RobotConfig& robot : config->robots) made->specs.push_back(robot.spec);
    kept = std::move(made);
  }
  for (std::size_t i = 0; i < config->robots.size(); ++i) config->robots[i].spec = kept->specs[i];
  notes->insert(notes->end(), kept->notes.begin(), kept->notes.end());
  return {mjcf::CopyOf(*kept->model), kept->scan};
}

// Those at which every robot can send.
std::vector<double> PossibleTimesteps(const config::Config& config) {
  const auto of = [&config](const config::RobotConfig& robot) {
    return robot::PossibleTimesteps(config.randomization.timestep, robot.spec.rates);
  };
  std::vector<double> steps = of(config.robots.front());
  for (const config::RobotConfig& robot : config.robots) {
    const std::vector<double> others = of(robot);
    std::erase_if(steps,
                  [&](double step) { return std::ranges::find(others, step) == others.end(); });
  }
  if (steps.empty()) {
    throw ConfigError("randomization.timestep: no step in it divides the periods of all robots");
  }
  return steps;
}

// Adds a warning for a robot whose model lacks what its motion service needs. Throws ModelError if
// it is to start standing, held up by that service.
void CheckMotion(const config::RobotConfig& robot, const physics::RobotBody& body, Notes* notes) {
  const std::string alias = authority::StartService(robot.spec, robot.motion);
  if (alias.empty()) return;
  const std::string misfit =
      motion::Misfit({.spec = body.spec(),
                      .service = authority::MotionService(body.spec(), alias),
                      .body = body,
                      .damping_kd = robot.gate.damping_kd});
  if (misfit.empty()) return;
  const std::string says = config::ModelFile(robot.spec).string() + ": motion service " + alias +
                           " cannot move this model: " + misfit;
  if (config::StartPoseOf(robot) == "standing") {
    throw ModelError(says +
                     "; or start otherwise (--start lying, hanging), or without it "
                     "(--set motion.service=none)");
  }
  notes->push_back({kWarning, says + "; it only damps"});
}

// `config` has the names of the model.
MadePhysics Made(const config::Config& config, Loaded loaded, mjcf::ModelHandle nominal,
                 robot::Draws draws, Notes notes, Reused* reused) {
  std::vector<physics::PlacedRobot> placed = PlacedRobots(config);
  physics::MujocoWorld world(std::move(loaded.model), placed, std::move(nominal),
                             reused == nullptr ? nullptr : std::move(reused->memory));
  world.Walk(config.objects);
  world.Show(std::move(loaded.scan));
  for (std::size_t i = 0; i < placed.size(); ++i) {
    if (IsThirdParty(config.robots[i])) CheckMotion(config.robots[i], world.robot(i), &notes);
    const std::string& look = config.robots[i].look;
    if (look.empty()) continue;
    notes.push_back({kInfo, "drawn by the meshes of " + physics::CheckLook(placed[i], look)});
  }
  return {.world = std::move(world),
          .draws = std::move(draws),
          .notes = std::move(notes),
          .sight = std::make_shared<const SightModel>(config)};
}

}  // namespace

MadePhysics MakePhysics(config::Config* config, Reused* reused) {
  Notes notes;
  robot::RandomizationSpec& ranges = config->randomization;
  if (!config::IsRandom(ranges)) {
    Loaded loaded = LoadOrCopyModel(config, reused, &notes);
    return Made(*config, std::move(loaded), nullptr, {}, std::move(notes), reused);
  }
  ranges.seed = SeedOf(ranges, &notes);
  robot::Randomizer randomizer(ranges.seed);
  if (!ranges.timestep.empty()) {
    config->physics.timestep = randomizer.DrawOneOf("timestep", PossibleTimesteps(*config));
  }
  Loaded loaded = LoadOrCopyModel(config, reused, &notes);
  mjcf::ModelHandle nominal = mjcf::CopyOf(*loaded.model);
  std::vector<robot::RobotSpec> in_model;
  for (config::RobotConfig& robot : config->robots) {
    const std::string prefix = config->PrefixOf(robot);
    robot::RandomizeMotors(ranges, prefix, &randomizer, &robot.spec);
    in_model.push_back(mjcf::WithPrefix(prefix, robot.spec));
  }
  mjcf::RandomizeModel(ranges, in_model, &randomizer, loaded.model.get());
  Add(randomizer.draws(), &notes);
  return Made(*config, std::move(loaded), std::move(nominal), randomizer.draws(), std::move(notes),
              reused);
}

std::unique_ptr<emulator::World> MakeWorld(physics::MujocoWorld physics,
                                           const config::Config& config, const PortsOf& ports,
                                           emulator::Inbox* inbox) {
  std::vector<emulator::RobotParts> robots;
  for (const config::RobotConfig& robot : config.robots) {
    robots.push_back({.spec = robot.spec,
                      .settings = config::RobotSettingsOf(robot),
                      .ports = ports(robots.size())});
  }
  return std::make_unique<emulator::World>(std::move(physics), config::WorldSettingsOf(config),
                                           robots, inbox);
}

}  // namespace understudy::assembly
