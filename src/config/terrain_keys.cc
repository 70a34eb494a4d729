#include "config/keys.h"
#include "objects/april_tags.h"

namespace understudy::config {
namespace {

void DescribePatch(Archive& a, terrain::TerrainPatch& p) {
  a.Word(UNDERSTUDY_NVP(p.kind), {"What it is"}, terrain::TerrainKinds());
  a.Key(UNDERSTUDY_NVP(p.difficulty), {"", {-1, 1}, "From 0 to 1; below 0 is terrain.difficulty"});
  a.Key(UNDERSTUDY_NVP(p.friction), {"", {0, 5}, "As terrain.friction; 0 uses that"});
  a.Key(UNDERSTUDY_NVP(p.length),
        {"m", {0, 100}, "Along +x, at least 2; 0 is the first of terrain.size"});
  a.Key(UNDERSTUDY_NVP(p.image), {"As terrain.image, which \"\" stands for"});
}

void DescribeScan(Archive& a, terrain::ScanSpec& s) {
  a.Key(UNDERSTUDY_NVP(s.pos), {"m", {-1000, 1000}, "Where the file's origin is in the world"});
  a.Key(UNDERSTUDY_NVP(s.quat),
        {"",
         {-1, 1},
         "How the file is turned: w, x, y, z; [0.7071, 0.7071, 0, 0] where its y axis is up"});
  a.Key(UNDERSTUDY_NVP(s.scale), {"m", {1e-6, 1e6}, "Of the file's unit; 0.001 for millimetres"});
  a.Key(UNDERSTUDY_NVP(s.height),
        {"m",
         {-1000, 1000},
         "Up to which height in the world its surfaces are touched (the default is assumed)"});
  a.Key(UNDERSTUDY_NVP(s.cell),
        {"m",
         {0.01, 1},
         "Cells of the height field that is touched in its stead (the default is assumed)"});
}

void DescribeTerrain(Archive& a, terrain::TerrainSpec& t) {
  a.Key(UNDERSTUDY_NVP(t.difficulty),
        {"", {0, 1}, "0 is nearly flat, 1 the hardest; docs/reference/terrain.md has the figures"});
  a.Key(UNDERSTUDY_NVP(t.clutter),
        {"",
         {0, 1},
         "How much lies about in a place that can be pushed over; it becomes objects of the "
         "configuration"});
  a.Key(UNDERSTUDY_NVP(t.friction),
        {"",
         {0, 5},
         "Friction of the ground; 0 = default: 0.8 (assumed), or what the robot's model says if "
         "that is more"});
  a.Key(UNDERSTUDY_NVP(t.size),
        {"m", {2, 100}, "Length of a patch along +x, width along y (defaults assumed)"});
  a.Key(UNDERSTUDY_NVP(t.seed), {"", {0, kMaxInt}, "Seed of its random parts"});
  a.Key(UNDERSTUDY_NVP(t.image),
        {"Grey PNG or PGM for kind image; each pixel is a grid point of the ground"});
  a.Key(UNDERSTUDY_NVP(t.image_height),
        {"m", {0, 50}, "Height of white above black at difficulty 1 (the default is assumed)"});
  a.List(UNDERSTUDY_NVP(t.patches), {"Patches of scene row, one after another along +x"},
         DescribePatch);
  a.Section(UNDERSTUDY_NVP(t.scan), {"Of a scene that is a scan, such as office.ply"},
            DescribeScan);
}

void DescribeCorner(Archive& a, objects::Corner& p) {
  a.Key(UNDERSTUDY_NVP(p.to), {"m", {-1000, 1000}, "Where in the world it is"});
  a.Key(UNDERSTUDY_NVP(p.wait), {"s", {0, 3600}, "How long the object stands there, each time"});
}

void DescribeObject(Archive& a, objects::ObjectSpec& o) {
  a.Word(UNDERSTUDY_NVP(o.kind), {"What it is"}, objects::ObjectKindNames());
  a.Key(UNDERSTUDY_NVP(o.name),
        {"What requests, conditions and viewers call it; \"\" is its kind, with a number from the "
         "second of a kind on, such as cube_2"});
  a.Key(UNDERSTUDY_NVP(o.pos),
        {"m", {-1000, 1000}, "Where the middle of its underside is in the world at the start"});
  a.Key(UNDERSTUDY_NVP(o.yaw), {"rad", {-10, 10}, "Its turn about the world's z axis"});
  a.Key(UNDERSTUDY_NVP(o.mass), {"kg", {0, 1000}, "0 is that of its kind"});
  a.Key(UNDERSTUDY_NVP(o.friction), {"", {0, 5}, "Sliding friction; 0 is that of its kind"});
  a.Key(UNDERSTUDY_NVP(o.id), {"", {0, objects::kAprilTags - 1}, "Which AprilTag a tag shows"});
  a.Key(UNDERSTUDY_NVP(o.image), {"PNG that a poster shows"});
  a.List(UNDERSTUDY_NVP(o.path),
         {"Corners that it walks to from pos on, stopping for nothing; [] is none"},
         DescribeCorner);
  a.Key(UNDERSTUDY_NVP(o.speed), {"m/s", {0, 5}, "At which it walks; 0 is that of its kind"});
  a.Key(UNDERSTUDY_NVP(o.wait), {"s", {0, 3600}, "How long it stands at pos, each time"});
  a.Choice(
      UNDERSTUDY_NVP(o.then),
      {"What it does at the last corner: the way back, straight to pos and round again, or stay"},
      {"back", "round", "stay"});
  a.Key(UNDERSTUDY_NVP(o.seed),
        {"", {0, kMaxInt}, "Draws where on its way it begins; 0 is at pos"});
}

}  // namespace

void DescribeScene(Archive& a, Config& c) {
  a.Key(
      UNDERSTUDY_NVP(c.scene),
      {"Ground: a kind of terrain, a place, row for terrain.patches, a name in models/scene; or a "
       "file, of MJCF, YAML or a scan"});
  a.Section(UNDERSTUDY_NVP(c.terrain), {"Generated ground (docs/reference/terrain.md)"},
            DescribeTerrain);
  a.List(UNDERSTUDY_NVP(c.objects),
         {"Things in the scene that robots push, grasp and see (docs/reference/objects.md)"},
         DescribeObject, &objects::ObjectSpec::name);
}

}  // namespace understudy::config
