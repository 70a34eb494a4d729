#include <cstdio>
#include <filesystem>
#include <memory>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "commands/commands.h"
#include "commands/set_options.h"
#include "config/load.h"
#include "mjcf/mesh_file.h"
#include "physics/world_model.h"
#include "terrain/terrain.h"

namespace understudy::commands {
namespace {

// The command line.
struct TerrainArguments : SetArguments {
  std::string scene;
  std::string out;
};

int TerrainCommand(const TerrainArguments& arguments) {
  std::vector<std::string> sets = arguments.sets;
  sets.insert(sets.begin(), "scene=" + arguments.scene);
  const config::Config config = config::LoadScene(
      {.robot = {}, .files = arguments.config_files, .sets = sets, .typed = arguments.typed});
  if (mjcf::IsMeshFile(config.scene)) {
    throw ModelError(config.scene +
                     " is a scan, which is a scene as it is: understudy run go2 --scene " +
                     config.scene);
  }
  if (!terrain::IsTerrain(config.scene)) {
    throw ModelError("no terrain '" + config.scene + "'" +
                     DidYouMean(config.scene, terrain::GeneratedScenes()));
  }
  terrain::WriteTerrain(config.scene, config.terrain, arguments.out);
  const std::filesystem::path file = std::filesystem::path(arguments.out) / "scene.xml";
  physics::LoadModelFile(file);  // checks that the written file loads
  std::printf("%s\n", file.c_str());
  return 0;
}

}  // namespace

void AddTerrainCommand(CLI::App* app, Chosen* chosen) {
  const auto arguments = std::make_shared<TerrainArguments>();
  CLI::App* terrain =
      app->add_subcommand("terrain", "Write the ground of a run as MJCF and pictures");
  terrain->add_option("scene", arguments->scene, "A kind of terrain, row, or a scene's YAML file")
      ->required()
      ->type_name("SCENE");
  terrain->add_option("--out", arguments->out, "Folder to write to; created if missing")
      ->required()
      ->type_name("DIR");
  AddShortOption(terrain, arguments.get(), "--difficulty", "terrain.difficulty", "D",
                 "0 is nearly flat, 1 the hardest [0.5]");
  AddShortOption(terrain, arguments.get(), "--friction", "terrain.friction", "MU",
                 "Sliding friction of every contact with the ground");
  AddShortOption(terrain, arguments.get(), "--seed", "terrain.seed", "N",
                 "Seed of its random parts [1]");
  AddShortOption(terrain, arguments.get(), "--image", "terrain.image", "FILE",
                 "Grey PNG or PGM for kind image");
  AddSetOptions(terrain, arguments.get(), "YAML file, as for a run", "terrain.size=[12,4]");
  terrain->footer(
      "Writes DIR/scene.xml, plain MJCF, and for each height field terrain_N.hf, which it names,\n"
      "and terrain_N.png, the same heights in 16 bits of grey.\n"
      "Examples:\n"
      "  understudy terrain rough --difficulty 0.7 --seed 3 --out field\n"
      "  understudy run go2 --scene field/scene.xml\n"
      "Kinds: flat, rough, waves, slopes, stairs_up, stairs_down, floating_stairs, gaps,\n"
      "stepping_stones, boxes, obstacles, image; row is terrain.patches, one after another.\n"
      "Places: apartment, office, warehouse, street; difficulty says how much stands about.");
  terrain->callback([=] { *chosen = [=] { return TerrainCommand(*arguments); }; });
}

}  // namespace understudy::commands
