#include "config/keys.h"

namespace understudy::config {
namespace {

void DescribePatch(Archive& a, terrain::TerrainPatch& p) {
  a.Word({"kind", "What it is"}, terrain::TerrainKinds(), &p.kind);
  a.Key({"difficulty", "", {-1, 1}, "From 0 to 1; below 0 is terrain.difficulty"}, &p.difficulty);
  a.Key({"friction", "", {0, 5}, "As terrain.friction, which 0 stands for"}, &p.friction);
  a.Key({"length", "m", {0, 100}, "Along +x, at least 2; 0 is the first of terrain.size"},
        &p.length);
  a.Key({"image", "As terrain.image, which \"\" stands for"}, &p.image);
}

void DescribeTerrain(Archive& a, terrain::TerrainSpec& t) {
  a.Key({"difficulty",
         "",
         {0, 1},
         "0 is nearly flat, 1 the hardest; docs/terrain.md says how hard that is"},
        &t.difficulty);
  a.Key({"friction",
         "",
         {0, 5},
         "Sliding friction of every contact with the ground; 0 is the larger of 0.8 (assumed) and "
         "what the robot's model says"},
        &t.friction);
  a.Key({"size", "m", {2, 100}, "Length of a patch along +x, width along y (defaults assumed)"},
        &t.size, 2);
  a.Key({"seed", "", {0, kMaxInt}, "Seed of all that is random in it"}, &t.seed);
  a.Key({"image", "Grey PNG or PGM of kind image; a pixel is a point of the ground"}, &t.image);
  a.Key({"image_height",
         "m",
         {0, 50},
         "Height of white over black at difficulty 1 (the default is assumed)"},
        &t.image_height);
  a.List({"patches", "Patches of scene row, one after another along +x"}, &t.patches,
         DescribePatch);
}

}  // namespace

void DescribeScene(Archive& a, Config& c) {
  a.Key({"scene",
         "Ground to stand on: a kind of terrain, row for terrain.patches, a name in models/scene, "
         "an MJCF file, or a YAML file that holds scene and terrain"},
        &c.scene);
  a.Section({"terrain", "Ground that is made (docs/terrain.md)"},
            [&] { DescribeTerrain(a, c.terrain); });
}

}  // namespace understudy::config
