#include "assembly/make_world.h"

#include <gmock/gmock.h>

#include "base/errors.h"
#include "config/load.h"
#include "tests/support/fake_port.h"
#include "tests/support/mujoco_test.h"

namespace understudy::assembly {
namespace {

config::Config ConfigOf(std::vector<std::string> sets = {}) {
  return config::LoadConfig({.robot = "go2", .sets = std::move(sets)}, UNDERSTUDY_SOURCE_DIR);
}

// What there is to say about the models is not looked at.
std::vector<Note> NotesOf(config::Config* config) {
  std::vector<Note> notes = MakePhysics(config).notes;
  std::erase_if(notes, [](const Note& note) { return note.level == Note::Level::kDebug; });
  return notes;
}

class MakeWorldTest : public test::MujocoTest {};

TEST_F(MakeWorldTest, NotesTheSeedAndEachQuantityThatWasDrawn) {
  config::Config config = ConfigOf({"randomization.seed=3", "randomization.delay=[0.001, 0.004]"});
  const std::vector<Note> notes = NotesOf(&config);
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_EQ(notes[0].text, "randomized from seed 3");
  EXPECT_EQ(notes[0].level, Note::Level::kInfo);
  EXPECT_THAT(notes[1].text, testing::StartsWith("drawn delay: 0.00"));
}

TEST_F(MakeWorldTest, WarnsOfASeedThatItDrewItselfAndKeepsIt) {
  config::Config config = ConfigOf({"randomization.delay=[0.001, 0.004]"});
  const std::vector<Note> notes = NotesOf(&config);
  ASSERT_FALSE(notes.empty());
  EXPECT_EQ(notes[0].level, Note::Level::kWarning);
  EXPECT_THAT(notes[0].text,
              testing::HasSubstr("--seed " + std::to_string(config.randomization.seed)));
}

TEST_F(MakeWorldTest, MakesTheSightModelOnceForAll) {
  config::Config config = ConfigOf();
  const std::shared_ptr<const SightModel> sight = MakePhysics(&config).sight;
  const std::shared_ptr<const mjModel> model = sight->Get();
  EXPECT_EQ(sight->Get(), model);
}

// A Go2 by --model, with a foot whose geoms are not in the model.
config::Config ConfigOfAFootless(std::vector<std::string> sets) {
  sets.insert(sets.end(),
              {std::string("robot.model=") + UNDERSTUDY_SOURCE_DIR + "/models/go2/go2.xml",
               "robot.feet={1: {name: tail, geoms: [none]}}"});
  return ConfigOf(std::move(sets));
}

TEST_F(MakeWorldTest, RefusesToStandWhereTheModelLacksWhatTheMotionServiceNeeds) {
  config::Config config = ConfigOfAFootless({"start.pose=standing"});
  try {
    MakePhysics(&config);
    FAIL() << "took it";
  } catch (const ModelError& error) {
    EXPECT_THAT(
        error.what(),
        testing::AllOf(testing::HasSubstr("go2.xml: motion service mcf cannot move"),
                       testing::HasSubstr("'tail'"), testing::HasSubstr("robot.feet.1.geoms"),
                       testing::HasSubstr("--set motion.service=none")));
  }
}

TEST_F(MakeWorldTest, WarnsOfAMotionServiceThatOnlyDamps) {
  config::Config config = ConfigOfAFootless({"start.pose=lying"});
  const auto only_damps = testing::Contains(
      testing::Field(&Note::text, testing::AllOf(testing::HasSubstr("motion service mcf cannot"),
                                                 testing::HasSubstr("it only damps"))));
  EXPECT_THAT(NotesOf(&config), only_damps);
  config::Config released = ConfigOfAFootless({"start.pose=standing", "motion.service=none"});
  EXPECT_THAT(NotesOf(&released), testing::Not(only_damps));
}

TEST_F(MakeWorldTest, GivesEachRobotThePortsOfItsNumber) {
  config::Config config = ConfigOf();
  test::FakePort port;
  emulator::Inbox inbox;
  std::vector<std::size_t> asked;
  const auto world = MakeWorld(
      MakePhysics(&config).world, config,
      [&](std::size_t robot) {
        asked.push_back(robot);
        return emulator::Ports{&port};
      },
      &inbox);
  EXPECT_THAT(asked, testing::ElementsAre(0u));
  world->Tick({});
  EXPECT_EQ(port.samples().size(), 1u);
}

}  // namespace
}  // namespace understudy::assembly
