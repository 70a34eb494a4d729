#include "config/keys.h"

namespace understudy::config {
namespace {

void DescribePatch(Archive& a, terrain::TerrainPatch& p) {
  a.Word(UNDERSTUDY_NVP(p.kind), {"What it is"}, terrain::TerrainKinds());
  a.Key(UNDERSTUDY_NVP(p.difficulty), {"", {-1, 1}, "From 0 to 1; below 0 is terrain.difficulty"});
  a.Key(UNDERSTUDY_NVP(p.friction), {"", {0, 5}, "As terrain.friction, which 0 stands for"});
  a.Key(UNDERSTUDY_NVP(p.length),
        {"m", {0, 100}, "Along +x, at least 2; 0 is the first of terrain.size"});
  a.Key(UNDERSTUDY_NVP(p.image), {"As terrain.image, which \"\" stands for"});
}

void DescribeTerrain(Archive& a, terrain::TerrainSpec& t) {
  a.Key(UNDERSTUDY_NVP(t.difficulty),
        {"", {0, 1}, "0 is nearly flat, 1 the hardest; docs/terrain.md says how hard that is"});
  a.Key(UNDERSTUDY_NVP(t.friction),
        {"",
         {0, 5},
         "Sliding friction of every contact with the ground; 0 is the larger of 0.8 (assumed) and "
         "what the robot's model says"});
  a.Key(UNDERSTUDY_NVP(t.size),
        {"m", {2, 100}, "Length of a patch along +x, width along y (defaults assumed)"});
  a.Key(UNDERSTUDY_NVP(t.seed), {"", {0, kMaxInt}, "Seed of all that is random in it"});
  a.Key(UNDERSTUDY_NVP(t.image),
        {"Grey PNG or PGM of kind image; a pixel is a point of the ground"});
  a.Key(UNDERSTUDY_NVP(t.image_height),
        {"m", {0, 50}, "Height of white over black at difficulty 1 (the default is assumed)"});
  a.List(UNDERSTUDY_NVP(t.patches), {"Patches of scene row, one after another along +x"},
         DescribePatch);
}

}  // namespace

void DescribeScene(Archive& a, Config& c) {
  a.Key(UNDERSTUDY_NVP(c.scene),
        {"Ground to stand on: a kind of terrain, row for terrain.patches, a name in models/scene, "
         "an MJCF file, or a YAML file that holds scene and terrain"});
  a.Section(UNDERSTUDY_NVP(c.terrain), {"Ground that is made (docs/terrain.md)"}, DescribeTerrain);
}

}  // namespace understudy::config
