// Tests the keys scene and terrain, and their errors.
#include "config/validate.h"
#include "config_fixture.h"

namespace understudy::config {
namespace {

using testing::HasSubstr;

class TerrainConfigTest : public ConfigFixture {
 protected:
  Config LoadWithScene(const std::string& text, std::vector<std::string> sets = {}) const {
    sets.insert(sets.begin(), "scene=" + Write("course.yaml", text));
    return Load({}, sets);
  }
  std::string SceneError(const std::string& text) const {
    return Relative(ErrorOf([&] { LoadWithScene(text); }));
  }
};

TEST_F(TerrainConfigTest, IsFlatUnlessToldOtherwise) {
  EXPECT_EQ(LoadText("").scene, "flat");
  EXPECT_EQ(LoadText("scene: rough\nterrain: {difficulty: 0.7}\n").terrain.difficulty, 0.7);
}

TEST_F(TerrainConfigTest, TakesTheSceneThatAFileHolds) {
  const Config config = LoadWithScene("scene: gaps\nterrain: {seed: 4, difficulty: 0.25}\n");
  EXPECT_EQ(config.scene, "gaps");
  EXPECT_EQ(config.terrain.seed, 4);
  EXPECT_EQ(config.terrain.difficulty, 0.25);
}

TEST_F(TerrainConfigTest, TakesAFileWithPatchesAloneForARow) {
  const Config config = LoadWithScene("terrain: {patches: [{kind: rough}, {kind: waves}]}\n");
  EXPECT_EQ(config.scene, "row");
  ASSERT_EQ(config.terrain.patches.size(), 2U);
  EXPECT_EQ(config.terrain.patches[1].kind, "waves");
}

TEST_F(TerrainConfigTest, LaysEverythingElseOverTheScenesFile) {
  const std::string text = "terrain: {difficulty: 0.1, patches: [{kind: rough}]}\n";
  const Config config =
      LoadWithScene(text, {"terrain.difficulty=0.9", "terrain.patches.0.kind=boxes"});
  EXPECT_EQ(config.terrain.difficulty, 0.9);
  EXPECT_EQ(config.terrain.patches[0].kind, "boxes");
}

TEST_F(TerrainConfigTest, PrintsASceneThatReadsBackTheSame) {
  const Config config = LoadWithScene("terrain: {patches: [{kind: rough, length: 3}]}\n");
  const std::string text = PrintConfig(config, false);
  EXPECT_EQ(PrintConfig(LoadText(text), false), text);
}

TEST_F(TerrainConfigTest, NeedsNoRobotForTheGroundAlone) {
  const Config config = LoadScene({.robot = {}, .files = {}, .sets = {"scene=rough"}});
  EXPECT_EQ(config.scene, "rough");
  EXPECT_EQ(Relative(ErrorOf(
                [] { LoadScene({.robot = {}, .files = {}, .sets = {"terrain.size=[1, 4]"}}); })),
            "--set terrain.size=[1, 4]: terrain.size.0: expected a number from 2 to 100 m, got "
            "'1'");
}

TEST_F(TerrainConfigTest, RefusesOtherKeysInTheScenesFile) {
  EXPECT_EQ(SceneError("scene: gaps\ngate: lenient\n"),
            "course.yaml:2: key 'gate': unknown; valid: scene, terrain, objects");
}

TEST_F(TerrainConfigTest, RefusesASceneThatNamesAnotherFile) {
  EXPECT_THAT(SceneError("scene: other.yaml\n"),
              HasSubstr("course.yaml:1: scene: a scene's own file cannot name another"));
}

TEST_F(TerrainConfigTest, RefusesASceneFileThatIsNotThere) {
  EXPECT_EQ(SetError("scene=nowhere.yaml"),
            "nowhere.yaml: cannot be read: No such file or directory");
}

TEST_F(TerrainConfigTest, RefusesASceneFileWhoseNameIsTooLong) {
  const std::string name(300, 'a');
  EXPECT_EQ(SetError("scene=" + name + ".yaml"),
            name + ".yaml: cannot be read: File name too long");
}

TEST_F(TerrainConfigTest, RefusesARowWithoutPatches) {
  EXPECT_EQ(FileError("scene: row\n"),
            "run.yaml:1: scene: 'row' needs terrain.patches, as in [{kind: rough}, {kind: gaps}]");
}

TEST_F(TerrainConfigTest, RefusesPatchesThatNothingAsksFor) {
  EXPECT_EQ(FileError("terrain:\n  patches: [{kind: rough}]\n"),
            "run.yaml:2: terrain.patches: nothing asks for them; set scene to row");
  EXPECT_EQ(LoadText("scene: flat\nterrain: {patches: [{kind: rough}]}\n").scene, "flat");
}

TEST_F(TerrainConfigTest, RefusesAPatchOfNoKind) {
  EXPECT_THAT(FileError("scene: row\nterrain: {patches: [{kind: ruogh}]}\n"),
              testing::AllOf(HasSubstr("run.yaml:2: terrain.patches.0.kind: expected one of flat"),
                             HasSubstr("did you mean 'rough'?")));
}

TEST_F(TerrainConfigTest, RefusesAPatchThatIsTooShort) {
  EXPECT_EQ(FileError("scene: row\nterrain: {patches: [{kind: flat, length: 1}]}\n"),
            "run.yaml:2: terrain.patches.0.length: expected 0 or at least 2 m, got 1");
}

TEST_F(TerrainConfigTest, RefusesDifficultyFrictionAndSizeOutOfRange) {
  EXPECT_EQ(SetError("terrain.difficulty=1.01"),
            "--set terrain.difficulty=1.01: terrain.difficulty: expected a number from 0 to 1, got "
            "'1.01'");
  EXPECT_THAT(SetError("terrain.friction=-1"), HasSubstr("expected a number from 0 to 5"));
  EXPECT_THAT(SetError("terrain.size=[8]"), HasSubstr("expected 2 numbers, got 1"));
  EXPECT_THAT(SetError("terrain.seed=1.5"), HasSubstr("expected a whole number"));
}

}  // namespace
}  // namespace understudy::config
