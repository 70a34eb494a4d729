#include "commands/terrain_command.h"

#include <cstdio>
#include <filesystem>

#include "config/load.h"
#include "physics/terrain.h"
#include "physics/world_model.h"
#include "robot/errors.h"
#include "robot/nearest_word.h"

namespace understudy {
namespace {

// An option that is short for a --set, which has the last word.
void AddSetOption(CLI::App* app, TerrainArguments* arguments, const std::string& key,
                  const std::string& type, const std::string& help) {
  app->add_option_function<std::string>(
         "--" + key,
         [arguments, key](const std::string& value) {
           arguments->sets.insert(arguments->sets.begin(), "terrain." + key + "=" + value);
         },
         help)
      ->type_name(type);
}

}  // namespace

CLI::App* AddTerrainCommand(CLI::App* app, TerrainArguments* arguments) {
  CLI::App* terrain = app->add_subcommand("terrain", "Write a run's ground as MJCF and pictures");
  terrain->add_option("scene", arguments->scene, "A kind of terrain, row, or a YAML that holds one")
      ->required()
      ->type_name("SCENE");
  terrain->add_option("--out", arguments->out, "Folder to write to; is made where it is missing")
      ->required()
      ->type_name("DIR");
  AddSetOption(terrain, arguments, "difficulty", "D", "From 0 to 1 [0.5]");
  AddSetOption(terrain, arguments, "friction", "MU", "Of every contact with the ground");
  AddSetOption(terrain, arguments, "seed", "N", "Of all that is random in it [1]");
  AddSetOption(terrain, arguments, "image", "FILE", "Grey PNG or PGM of kind image");
  terrain->add_option("--config", arguments->config_files, "YAML file, as of a run")
      ->type_name("FILE")
      ->take_all();
  terrain
      ->add_option_function<std::vector<std::string>>(
          "--set",
          [arguments](const std::vector<std::string>& sets) {
            arguments->sets.insert(arguments->sets.end(), sets.begin(), sets.end());
          },
          "Sets one key, e.g. --set terrain.size=[12,4]; may be given again")
      ->type_name("KEY=VALUE")
      ->take_all();
  terrain->footer(
      "Writes DIR/scene.xml, plain MJCF, and for each height field terrain_N.hf, which it names,\n"
      "and terrain_N.png, the same heights in 16 bits of grey.\n"
      "Examples:\n"
      "  understudy terrain rough --difficulty 0.7 --seed 3 --out field\n"
      "  understudy run go2 --scene field/scene.xml\n"
      "Kinds: flat, rough, waves, slopes, stairs_up, stairs_down, floating_stairs, gaps,\n"
      "stepping_stones, boxes, obstacles, image; row is terrain.patches, one after another.");
  return terrain;
}

int TerrainCommand(const TerrainArguments& arguments) {
  std::vector<std::string> sets = arguments.sets;
  sets.insert(sets.begin(), "scene=" + arguments.scene);
  const Config config = LoadScene({.robot = {}, .files = arguments.config_files, .sets = sets});
  if (!IsTerrain(config.scene)) {
    std::vector<std::string> scenes = TerrainKinds();
    scenes.emplace_back(kPatchesScene);
    throw ModelError("no terrain '" + config.scene + "'" + DidYouMean(config.scene, scenes));
  }
  WriteTerrain(config.scene, config.terrain, arguments.out);
  const std::filesystem::path file = std::filesystem::path(arguments.out) / "scene.xml";
  LoadModelFile(file);  // what we say is there loads
  std::printf("%s\n", file.c_str());
  return 0;
}

}  // namespace understudy
