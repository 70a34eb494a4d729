// Tests the key objects and its errors.
#include "config_fixture.h"

namespace understudy::config {
namespace {

using testing::HasSubstr;

class ObjectsConfigTest : public ConfigFixture {};

TEST_F(ObjectsConfigTest, AreNoneUnlessToldOtherwise) {
  EXPECT_TRUE(LoadText("").objects.empty());
  const Config config = LoadText(
      "objects:\n  - {kind: cup, name: mine, pos: [1, 2, 3], yaw: 0.5, mass: 0.2, friction: 0.9}\n"
      "  - {kind: table}\n");
  ASSERT_EQ(config.objects.size(), 2U);
  const objects::ObjectSpec& cup = config.objects[0];
  EXPECT_EQ(cup.kind, "cup");
  EXPECT_EQ(cup.name, "mine");
  EXPECT_EQ(cup.pos, (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(cup.yaw, 0.5);
  EXPECT_EQ(cup.mass, 0.2);
  EXPECT_EQ(cup.friction, 0.9);
}

TEST_F(ObjectsConfigTest, MayStandInTheFileOfAScene) {
  const std::string scene = Write("room.yaml", "scene: flat\nobjects: [{kind: chair}]\n");
  EXPECT_EQ(Load({}, {"scene=" + scene}).objects.size(), 1U);
}

TEST_F(ObjectsConfigTest, PrintWhatReadsBackTheSame) {
  const std::string text =
      PrintConfig(LoadText("objects: [{kind: ball, pos: [1, 0, 0], mass: 0.2}]\n"), false);
  EXPECT_EQ(PrintConfig(LoadText(text), false), text);
}

TEST_F(ObjectsConfigTest, LieAboutInAPlaceAsItsClutterSays) {
  const std::string text = "scene: warehouse\nterrain: {clutter: 1, seed: 3}\n";
  const Config config = LoadText(text + "objects: [{kind: chair, pos: [0, 2, 0]}]\n");
  ASSERT_GT(config.objects.size(), 5U);
  EXPECT_EQ(config.objects[0].kind, "chair");
  for (std::size_t i = 1; i < config.objects.size(); ++i) {
    EXPECT_EQ(config.objects[i].name, "loose_" + std::to_string(i));
    EXPECT_FALSE(objects::IsFixed(config.objects[i]));
  }
  const std::array<double, 3>& there = config.objects[2].pos;
  const std::string onto =
      "start: {at: [" + std::to_string(there[0]) + ", " + std::to_string(there[1]) + ", 0]}\n";
  EXPECT_LT(LoadText(text + onto).objects.size(), config.objects.size() - 1);
}

TEST_F(ObjectsConfigTest, LieAboutOnceThoughTheyArePrintedWithTheClutter) {
  const Config config = LoadText("scene: office\nterrain: {clutter: 1}\n");
  ASSERT_GT(config.objects.size(), 3U);
  const std::string text = PrintConfig(config, false);
  EXPECT_EQ(PrintConfig(LoadText(text), false), text);
}

TEST_F(ObjectsConfigTest, LieAboutInPlacesAlone) {
  EXPECT_TRUE(LoadText("scene: rough\nterrain: {clutter: 1}\n").objects.empty());
}

TEST_F(ObjectsConfigTest, AreOfKindsThatThereAre) {
  EXPECT_THAT(FileError("objects: [{kind: botle}]\n"),
              testing::AllOf(HasSubstr("run.yaml:1: objects.0.kind: expected one of cube"),
                             HasSubstr("did you mean 'bottle'?")));
}

TEST_F(ObjectsConfigTest, HaveBounds) {
  EXPECT_EQ(FileError("objects:\n  - kind: cube\n    mass: -1\n"),
            "run.yaml:3: objects.0.mass: expected a number from 0 to 1000 kg, got '-1'");
  EXPECT_THAT(FileError("objects: [{friction: 9}]\n"),
              HasSubstr("objects.0.friction: expected a number from 0 to 5, got '9'"));
  EXPECT_THAT(FileError("objects: [{pos: [0, 0, 1e9]}]\n"), HasSubstr("objects.0.pos.2: expected"));
  EXPECT_THAT(FileError("objects: [{yaw: .nan}]\n"), HasSubstr("objects.0.yaw: expected"));
}

TEST_F(ObjectsConfigTest, HaveNamesOfTheirOwn) {
  EXPECT_EQ(FileError("objects:\n  - {kind: cube}\n  - {kind: cup,\n     name: cube}\n"),
            "run.yaml:4: objects.1.name: 'cube' is that of objects.0 too");
  EXPECT_THAT(FileError("objects: [{name: my cube}]\n"),
              HasSubstr("objects.0.name: expected at most 40 letters, digits, _ and -, got 'my "
                        "cube'"));
  EXPECT_THAT(FileError("objects: [{name: left/cube}]\n"), HasSubstr("got 'left/cube'"));
  EXPECT_THAT(FileError("objects: [{name: " + std::string(41, 'a') + "}]\n"),
              HasSubstr("expected at most 40"));
}

TEST_F(ObjectsConfigTest, HaveNoMassWhereTheyAreFixed) {
  EXPECT_EQ(FileError("objects: [{kind: table, mass: 3}]\n"),
            "run.yaml:1: objects.0.mass: a table is fixed to the world; expected 0");
}

TEST_F(ObjectsConfigTest, MayWalkAlongAPath) {
  const Config config = LoadText(
      "objects:\n  - {kind: person, path: [{to: [1, 2]}, {to: [3, 2], wait: 4}], then: round,\n"
      "     wait: 5, seed: 7}\n  - {kind: chair, path: [{to: [1, 2]}], speed: 0.5}\n");
  const objects::ObjectSpec& person = config.objects[0];
  ASSERT_EQ(person.path.size(), 2U);
  EXPECT_EQ(person.path[1].to, (std::array<double, 2>{3, 2}));
  EXPECT_EQ(person.path[1].wait, 4);
  EXPECT_EQ(person.wait, 5);
  EXPECT_EQ(person.then, objects::PathEnd::kRound);
  EXPECT_EQ(person.seed, 7);
  EXPECT_EQ(config.objects[1].speed, 0.5);
  EXPECT_EQ(config.objects[1].then, objects::PathEnd::kBack);
  const std::string text = PrintConfig(config, false);
  EXPECT_EQ(PrintConfig(LoadText(text), false), text);
}

TEST_F(ObjectsConfigTest, SayWhyTheyCannotWalk) {
  EXPECT_EQ(
      FileError("objects:\n  - kind: chair\n    path: [{to: [1, 2]}]\n"),
      "run.yaml:3: objects.0.path: a chair has no speed of its own; expected speed beside it");
  EXPECT_EQ(FileError("objects:\n  - kind: person\n    path: [{to: [1, 2]}]\n    mass: 70\n"),
            "run.yaml:4: objects.0.mass: nothing moves what walks; expected 0");
  EXPECT_THAT(FileError("objects: [{kind: person, yaw: 1, path: [{to: [1, 2]}]}]\n"),
              HasSubstr("objects.0.yaw: what walks looks where it goes; expected 0"));
  EXPECT_EQ(FileError("objects:\n  - kind: person\n    path:\n      - {to: [1, 2]}\n"
                      "      - {to: [1, 2]}\n"),
            "run.yaml:5: objects.0.path.1.to: it is there already; expected another place");
  EXPECT_THAT(FileError("objects: [{kind: person, path: [{to: [0, 0]}]}]\n"),
              HasSubstr("objects.0.path.0.to: it is there already"));
  EXPECT_THAT(
      FileError("objects: [{kind: person, then: round, path: [{to: [1, 0]}, {to: [0, 0]}]}]\n"),
      HasSubstr("objects.0.path: round goes back to pos by itself"));
  EXPECT_THAT(FileError("objects: [{kind: person, then: rond, path: [{to: [1, 0]}]}]\n"),
              HasSubstr("did you mean 'round'?"));
  for (const char* const key : {"speed: 1", "wait: 1", "then: stay", "seed: 1"}) {
    EXPECT_THAT(FileError(std::string("objects: [{kind: person, ") + key + "}]\n"),
                HasSubstr("is of a path, and this object has none; expected path"))
        << key;
  }
  std::string corners;
  for (std::size_t i = 0; i <= objects::kMostCorners; ++i) {
    corners += "{to: [" + std::to_string(i + 1) + ", 0]},";
  }
  EXPECT_THAT(FileError("objects: [{kind: person, path: [" + corners + "]}]\n"),
              HasSubstr("objects.0.path: expected at most 64, got 65"));
}

TEST_F(ObjectsConfigTest, ShowAnAprilTagWhereTheyAreOne) {
  EXPECT_EQ(LoadText("objects: [{kind: tag, id: 586}]\n").objects[0].id, 586);
  EXPECT_EQ(FileError("objects: [{kind: tag, id: 587}]\n"),
            "run.yaml:1: objects.0.id: expected a whole number from 0 to 586, got '587'");
  EXPECT_EQ(FileError("objects: [{kind: checkerboard, id: 1}]\n"),
            "run.yaml:1: objects.0.id: a checkerboard shows no AprilTag; expected 0");
}

TEST_F(ObjectsConfigTest, ShowAPictureWhereTheyAreAPoster) {
  EXPECT_EQ(LoadText("objects: [{kind: poster, image: a.png}]\n").objects[0].image, "a.png");
  EXPECT_EQ(FileError("objects: [{kind: cube, image: a.png}]\n"),
            "run.yaml:1: objects.0.image: a cube shows no picture; expected none");
}

TEST_F(ObjectsConfigTest, AreNotTooMany) {
  std::string list;
  for (std::size_t i = 0; i < objects::kMostObjects; ++i) list += "{kind: cube},";
  EXPECT_EQ(LoadText("objects: [" + list + "]\n").objects.size(), objects::kMostObjects);
  EXPECT_EQ(FileError("objects: [" + list + "{kind: cube}]\n"),
            "run.yaml:1: objects: expected at most 32, got 33");
}

}  // namespace
}  // namespace understudy::config
