#include "terrain/terrain.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <map>
#include <vector>

#include <mujoco/mujoco.h>

#include "tests/terrain/fixture.h"

namespace understudy::terrain {
namespace {

using testing::HasSubstr;

// All files of a folder by name.
std::map<std::string, std::string> Files(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    files[entry.path().filename()] = Bytes(entry.path());
  }
  return files;
}

TEST_F(TerrainTest, IsTheSameToTheBitForTheSameSeed) {
  UseImage();
  for (const std::string& kind : TerrainKinds()) {
    EXPECT_TRUE(Files(Write(kind, "a_" + kind)) == Files(Write(kind, "b_" + kind))) << kind;
  }
}

TEST_F(TerrainTest, DiffersForAnotherSeedWhereThereIsChance) {
  for (const char* kind : {"rough", "stepping_stones", "boxes", "obstacles"}) {
    spec_.seed = 1;
    const auto one = Files(Write(kind, std::string("a_") + kind));
    spec_.seed = 2;
    EXPECT_FALSE(one == Files(Write(kind, std::string("b_") + kind))) << kind;
  }
}

TEST_F(TerrainTest, IsWhatItWasWhenTheseTestsWereWritten) {
  Load("rough");
  EXPECT_NEAR(Height(5, 0.05), 0.0279, 1e-6);
  Load("boxes");
  EXPECT_NEAR(Height(5, 0.1), 0.0487, 1e-6);
}

TEST_F(TerrainTest, IsNearlyFlatAtDifficultyNullAndHarderTheHigher) {
  UseImage();
  for (const std::string& kind : TerrainKinds()) {
    if (kind == "flat") continue;
    double last = -1;
    for (const double difficulty : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      spec_.difficulty = difficulty;
      Load(kind);
      const double now = Unevenness();
      if (difficulty == 0) {
        EXPECT_LT(now, 0.1) << kind;  // ten steps of 0.01 m
      }
      EXPECT_GT(now, last) << kind << " at " << difficulty;
      last = now;
    }
    EXPECT_GT(last, 0.01) << kind;
  }
}

TEST_F(TerrainTest, IsFlatAroundTheOriginAndLevelAtTheEdgeOfThePlatform) {
  UseImage();
  spec_.difficulty = 1;
  for (const std::string& kind : TerrainKinds()) {
    Load(kind);
    for (const double x : {-1.4, 0.0, 1.4}) {
      for (const double y : {-1.4, 0.0, 1.4}) EXPECT_NEAR(Height(x, y), 0, 1e-6) << kind;
    }
  }
}

TEST_F(TerrainTest, StairsHaveTheRiseAndTreadOfTheirDifficulty) {
  for (const auto& [kind, sign] :
       {std::pair{"stairs_up", 1}, {"stairs_down", -1}, {"floating_stairs", 1}}) {
    spec_.difficulty = 0.5;
    Load(kind);
    for (int step = 0; step < 10; ++step) {
      EXPECT_NEAR(Height(1.5 + 0.3 * step + 0.01, 0.3), sign * 0.12 * (step + 1), 1e-6) << kind;
      EXPECT_NEAR(Height(1.5 + 0.3 * step + 0.29, 0.3), sign * 0.12 * (step + 1), 1e-6) << kind;
    }
    EXPECT_NEAR(Height(9, 0), sign * 1.2, 1e-6);   // the landing
    EXPECT_NEAR(Height(11, 0), sign * 1.2, 1e-6);  // and the last platform
  }
}

TEST_F(TerrainTest, FloatingStairsAreOpenBetweenTheTreads) {
  spec_.difficulty = 1;  // rise 0.23 m, treads 0.04 m thick
  Load("floating_stairs");
  const mjtNum from[3] = {0, 0, 0.1}, ahead[3] = {1, 0, 0};
  EXPECT_GT(CastRay(mj_ray, model_.get(), data_.get(), from, ahead), 4);
}

TEST_F(TerrainTest, GapsHaveTheWidthOfTheirDifficulty) {
  spec_.difficulty = 0.4;
  Load("gaps");
  for (int gap = 0; gap < 6; ++gap) {
    const double x = 1.5 + 1.2 * gap;
    EXPECT_NEAR(Height(x - 0.001, 0), 0, 1e-6);
    EXPECT_NEAR(Height(x + 0.001, 0), -0.5, 1e-6);
    EXPECT_NEAR(Height(x + 0.399, 0), -0.5, 1e-6);
    EXPECT_NEAR(Height(x + 0.401, 0), 0, 1e-6);
  }
}

TEST_F(TerrainTest, SlopesHaveTheGradeOfTheirDifficulty) {
  spec_.difficulty = 0.5;
  Load("slopes");
  EXPECT_NEAR(Height(2.5, 0), 0.2, 1e-4);
  EXPECT_NEAR(Height(4.5, 0), 0.6, 1e-4);
  EXPECT_NEAR(Height(5.5, 0), 0.7, 1e-4);
  EXPECT_NEAR(Height(8.5, 0), 0.2, 1e-4);
}

TEST_F(TerrainTest, AWheelFeelsASlopeAsItLiesFromItsFootOn) {
  spec_.difficulty = 0.5;
  constexpr double kGrade = 0.2, kRadius = 0.113, kDeep = 0.002;  // m: a B2-W's
  const auto scene = Write("slopes") / "scene.xml";
  model_ = physics::LoadModelFile(folder_.Write(
      "wheel.xml", "<mujoco><include file='" + scene.string() +
                       "'/><worldbody><body><freejoint/><geom type='cylinder' size='0.113 0.025' "
                       "mass='1' quat='1 1 0 0'/></body></worldbody></mujoco>"));
  data_.reset(mj_makeData(model_.get()));
  const double c = 1 / std::hypot(1, kGrade), s = kGrade * c;
  int met = 0;
  for (double way = 0.02; way < 3; way += 0.02) {
    data_->qpos[0] = 1.5 + c * way - s * (kRadius - kDeep);
    data_->qpos[2] = s * way + c * (kRadius - kDeep);
    mj_forward(model_.get(), data_.get());
    for (int i = 0; i < data_->ncon; ++i) {
      const mjContact& contact = data_->contact[i];
      const bool level = data_->geom_xmat[9 * contact.geom1 + 8] > 0.999;
      if (level) continue;
      ++met;
      EXPECT_GT(std::abs(c * contact.frame[2] - s * contact.frame[0]), 0.999) << way;
    }
  }
  EXPECT_GE(met, 149);
}

TEST_F(TerrainTest, RoughGroundReachesTheHeightOfItsDifficulty) {
  spec_.difficulty = 0.5;
  WriteTerrain("rough", spec_, folder_.path());
  model_ = physics::LoadModelFile(folder_.path() / "scene.xml");
  ASSERT_EQ(model_->nhfield, 1);
  const double low = model_->geom_pos[3 * (model_->ngeom - 1) + 2];
  EXPECT_GT(model_->hfield_size[2], 0.05);
  EXPECT_LE(model_->hfield_size[2], 0.1 + 1e-9);
  EXPECT_GE(low, -0.05 - 1e-9);
}

TEST_F(TerrainTest, ImageHeightsAreThoseOfThePixels) {
  UseImage();
  spec_.difficulty = 0.5;
  spec_.image_height = 2;  // white is 1 m
  Load("image");
  EXPECT_NEAR(Height(1.5 + 1e-6, 2 - 1e-6), 0, 1e-4);  // the upper left pixel
  EXPECT_NEAR(Height(5.5, 2 - 1e-6), 0.5, 1e-3);
  EXPECT_NEAR(Height(9.5 - 1e-6, 2 - 1e-6), 1, 1e-4);
  EXPECT_NEAR(Height(1.5 + 1e-6, -2 + 1e-6), 1, 1e-4);
  EXPECT_NEAR(Height(9.5 - 1e-6, -2 + 1e-6), 0, 1e-4);
}

TEST_F(TerrainTest, PicturesOfHeightsReadBackAsTheSameGround) {
  const std::filesystem::path rough = Write("rough", "rough");
  const GreyImage picture = ReadGreyImage(rough / "terrain_0.png");
  std::int32_t sides[2];
  const std::string binary = Bytes(rough / "terrain_0.hf");
  std::memcpy(sides, binary.data(), sizeof sides);
  ASSERT_EQ(picture.height, sides[0]);
  ASSERT_EQ(picture.width, sides[1]);
  std::vector<float> z(picture.grey.size());
  std::memcpy(z.data(), binary.data() + sizeof sides, sizeof(float) * z.size());
  const float low = *std::min_element(z.begin(), z.end());
  for (int row = 0; row < sides[0]; ++row) {
    for (int column = 0; column < sides[1]; ++column) {
      const auto up = static_cast<std::size_t>((sides[0] - 1 - row) * sides[1] + column);
      const auto down = static_cast<std::size_t>(row * sides[1] + column);
      // 0.1 mm per grey level
      ASSERT_NEAR(low + picture.grey[down] * 65535 * 1e-4, z[up], 1e-6);
    }
  }
}

TEST_F(TerrainTest, ARowBeginsEachPatchWhereTheLastOneEnds) {
  spec_.patches = {{.kind = "stairs_up", .difficulty = 0.5, .length = 5},
                   {.kind = "gaps", .difficulty = 0.4, .length = 6},
                   {.kind = "stairs_down", .difficulty = 0.5, .length = 5}};
  Load("row");
  EXPECT_NEAR(Height(6.4, 0), 1.2, 1e-6);
  EXPECT_NEAR(Height(6.6, 0), 0.7, 1e-6);  // the first gap's pit
  EXPECT_NEAR(Height(7, 0), 1.2, 1e-6);
  EXPECT_NEAR(Height(12.6, 0), 1.08, 1e-6);
  EXPECT_NEAR(Height(17, 0), 0, 1e-6);
}

TEST_F(TerrainTest, PatchesTakeFromTheWholeWhatTheyDoNotSay) {
  spec_.difficulty = 0.5;
  spec_.friction = 0.6;
  spec_.patches = {{.kind = "stairs_up"}, {.kind = "boxes", .difficulty = 0, .friction = 0.4}};
  Load("row");
  EXPECT_NEAR(Height(1.6, 0), 0.12, 1e-6);
  std::map<double, int> frictions;
  for (int i = 0; i < model_->ngeom; ++i) ++frictions[model_->geom_friction[3 * i]];
  EXPECT_EQ(frictions.size(), 2U);
  EXPECT_EQ(frictions[0.4], 1);
}

TEST_F(TerrainTest, AFlatPatchOfAFloorsHeightHasItsOwnFriction) {
  spec_.patches = {{.kind = "flat"}, {.kind = "flat", .friction = 0.25}};
  Load("row");
  EXPECT_NEAR(Height(1.6, 0), 0, 1e-6);
  std::map<double, int> frictions;
  for (int i = 0; i < model_->ngeom; ++i) ++frictions[model_->geom_friction[3 * i]];
  EXPECT_EQ(frictions[0.25], 1);
}

TEST_F(TerrainTest, APatchLooksTheSameWhateverStandsBeforeIt) {
  spec_.patches = {{.kind = "flat"}, {.kind = "boxes"}};
  Load("row");
  const double box = Height(12, 0);
  spec_.patches[0].kind = "rough";
  Load("row");
  EXPECT_NEAR(Height(12, 0), box, 1e-9);
}

TEST_F(TerrainTest, PatchesOfHeightsMayBeManyAndWide) {
  for (const std::size_t count : {1U, 6U}) {
    spec_.size = {8, 16};
    spec_.patches.assign(count, {.kind = "rough", .difficulty = 1});
    Load("row");  // MuJoCo has no room for the pairs of bodies with height fields
    EXPECT_EQ(static_cast<std::size_t>(model_->nhfield), count);
  }
}

TEST_F(TerrainTest, FlatIsTheFlatSceneOfTheModels) {
  const mjcf::ModelHandle made = physics::LoadModelFile(Write("flat") / "scene.xml");
  const mjcf::ModelHandle drawn = physics::LoadModelFile(
      std::filesystem::path(UNDERSTUDY_SOURCE_DIR) / "models/scene/flat.xml");
  ASSERT_EQ(made->ngeom, 1);
  ASSERT_EQ(drawn->ngeom, 1);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(made->geom_friction[i], drawn->geom_friction[i]);
    EXPECT_EQ(made->geom_size[i], drawn->geom_size[i]);
  }
  EXPECT_EQ(made->geom_priority[0], drawn->geom_priority[0]);
  EXPECT_EQ(made->geom_condim[0], drawn->geom_condim[0]);
  EXPECT_EQ(made->nlight, drawn->nlight);
  EXPECT_EQ(made->ntexdata, drawn->ntexdata);
}

TEST_F(TerrainTest, HasARowInTheDocumentForEachKind) {
  const std::string document = Bytes(UNDERSTUDY_SOURCE_DIR "/docs/reference/terrain.md");
  for (const std::string& kind : TerrainKinds()) {
    EXPECT_THAT(document, HasSubstr("\n| `" + kind + "` | "));
  }
}

TEST_F(TerrainTest, RefusesARowWithoutPatches) {
  EXPECT_THAT(Refusal("row"), HasSubstr("needs terrain.patches"));
}

TEST_F(TerrainTest, RefusesAKindThatIsNone) {
  EXPECT_EQ(Refusal("hills"), "no kind of terrain 'hills'");
}

TEST_F(TerrainTest, RefusesARowOfTooManyPatches) {
  spec_.patches.resize(101);
  EXPECT_EQ(Refusal("row"), "terrain.patches has 101 patches; expected at most 100");
}

TEST_F(TerrainTest, RefusesMorePiecesThanItCanCarry) {
  spec_.size = {100, 100};
  EXPECT_THAT(Refusal("boxes"), HasSubstr("more than 4000 pieces"));
}

TEST_F(TerrainTest, RefusesAnImageThatIsNotNamed) {
  EXPECT_THAT(Refusal("image"), HasSubstr("needs terrain.image"));
}

TEST_F(TerrainTest, RefusesAFolderThatCannotBeMade) {
  std::ofstream(folder_.path() / "scene") << "in the way";
  EXPECT_THAT(Refusal("flat"), HasSubstr("cannot be made"));
}

}  // namespace
}  // namespace understudy::terrain
