#include "run/make_world.h"

#include <filesystem>
#include <map>
#include <random>
#include <span>
#include <string>
#include <utility>

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include "config/model_files.h"
#include "config/randomization_keys.h"
#include "mjcf/randomize_model.h"
#include "physics/world_model.h"

namespace understudy::run {
namespace {

// Logs the notes of loading a model.
void Tell(const physics::LoadNotes& notes) {
  for (const std::string& warning : notes.warnings) spdlog::warn("{}", warning);
  if (!notes.rewrites.empty()) {
    spdlog::info(
        "{} places of the model were rewritten for this MuJoCo (`understudy check` lists them)",
        notes.rewrites.size());
  }
  for (const mjcf::Rewrite& rewrite : notes.rewrites) spdlog::debug("{}", rewrite.text());
  for (const std::string& looks : notes.looks) spdlog::debug("{}", looks);
}

// Logs one line per quantity, to four digits; GET /status and a recording have all of them.
void Tell(const robot::Draws& draws) {
  std::map<std::string, std::string> lines;
  for (const robot::Drawn& drawn : draws.values) {
    std::string& line = lines[drawn.quantity];
    if (!line.empty()) line += ", ";
    line += (drawn.element.empty() ? "" : drawn.element + " ") + fmt::format("{:.4g}", drawn.value);
  }
  for (const auto& [quantity, line] : lines) spdlog::info("drawn {}: {}", quantity, line);
}

int SeedOf(const robot::RandomizationSpec& randomization) {
  if (randomization.seed >= 0) {
    spdlog::info("randomized from seed {}", randomization.seed);
    return randomization.seed;
  }
  const int seed = static_cast<int>(std::random_device()() & 0x7fffffffU);
  spdlog::warn("randomized from seed {}, drawn for this run: --seed {} repeats it", seed, seed);
  return seed;
}

physics::PlacedRobot Placed(const config::Config& config, const std::filesystem::path& file) {
  const auto& [x, y, yaw] = config.start.at;
  return {.spec = config.robot, .file = file, .x = x, .y = y, .yaw = yaw};
}

// A third-party model may have other names than the robot's description, which then takes them.
mjcf::ModelHandle LoadModel(config::Config* config) {
  const config::SceneFile scene(config->scene, config->terrain);
  const std::filesystem::path file = config::ModelFile(config->robot);
  const double timestep = config->physics.timestep;
  physics::LoadNotes notes;
  mjcf::ModelHandle model;
  if (std::filesystem::path(config->robot.model).is_relative()) {
    model = physics::LoadWorldModel({Placed(*config, file)}, scene.path(), timestep, &notes);
  } else {
    physics::FittedModel fitted =
        physics::LoadFittedModel(Placed(*config, file), scene.path(), timestep, &notes);
    config->robot = std::move(fitted.spec);
    model = std::move(fitted.model);
  }
  Tell(notes);
  return model;
}

// Called after loading the model, which may change the robot's description.
physics::World WorldOf(mjcf::ModelHandle model, const config::Config& config,
                       mjcf::ModelHandle nominal = nullptr) {
  return {std::move(model), {Placed(config, {})}, std::move(nominal)};
}

}  // namespace

MadeWorld MakeWorld(config::Config* config) {
  robot::RandomizationSpec& ranges = config->randomization;
  if (!config::IsRandom(ranges)) return {.world = WorldOf(LoadModel(config), *config), .draws = {}};
  ranges.seed = SeedOf(ranges);
  robot::Dice dice(ranges.seed);
  if (!ranges.timestep.empty()) {
    config->physics.timestep =
        dice.DrawOneOf("timestep", robot::PossibleTimesteps(ranges.timestep, config->robot.rates));
  }
  mjcf::ModelHandle model = LoadModel(config);
  mjcf::ModelHandle nominal = mjcf::CopyOf(*model);
  robot::RandomizeMotors(ranges, &dice, &config->robot);
  mjcf::RandomizeModel(ranges, std::span(&config->robot, 1), &dice, model.get());
  Tell(dice.draws());
  return {.world = WorldOf(std::move(model), *config, std::move(nominal)), .draws = dice.draws()};
}

mjcf::ModelHandle MakeSightModel(const config::Config& config) {
  const config::SceneFile scene(config.scene, config.terrain);
  return physics::LoadSightModel({Placed(config, config::ModelFile(config.robot))}, scene.path(),
                                 config.physics.timestep);
}

}  // namespace understudy::run
