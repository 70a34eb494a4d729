#include "viewer/scene_state.h"

#include <cmath>

#include "base/errors.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"

namespace understudy::viewer {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(SceneStateTest, ReadsASnapshot) {
  const SceneState state = ReadSnapshot(
      R"({"step": 7, "time": 0.007, "speed": 2, "paused": true, "qpos": [1, 2.5],
          "contacts": [{"at": [1, 2, 3], "force": [0, 0, 9], "geoms": [0, 4]}],
          "pushes": [{"body": "trunk", "at": [0, 0, 1], "force": [5, 0, 0]}],
          "crane": {"attached": true, "hook": [0, 0, 1], "top": [0, 0, 2], "tension": 150},
          "remote": {"keys": "L2+B", "lx": 0}, "battery": {"soc": 1}})",
      2);
  EXPECT_EQ(state.step, 7);
  EXPECT_EQ(state.time, 0.007);
  EXPECT_EQ(state.speed, 2);
  EXPECT_TRUE(state.paused);
  EXPECT_THAT(state.qpos, ElementsAre(1, 2.5));
  ASSERT_EQ(state.contacts.size(), 1U);
  EXPECT_THAT(state.contacts[0].force, ElementsAre(0, 0, 9));
  ASSERT_EQ(state.pushes.size(), 1U);
  EXPECT_EQ(state.crane->tension, 150);
  EXPECT_EQ(state.keys, "L2+B");
}

TEST(SceneStateTest, NeedsNoMoreThanPositions) {
  const SceneState state = ReadSnapshot(R"({"step": 0, "time": 0, "qpos": []})", 0);
  EXPECT_TRUE(state.contacts.empty());
  EXPECT_FALSE(state.crane);
  EXPECT_EQ(state.keys, "");
}

TEST(SceneStateTest, HasNoCraneWhereTheRobotDoesNotHang) {
  EXPECT_FALSE(ReadSnapshot(R"({"step": 0, "time": 0, "qpos": [],
                             "crane": {"attached": false, "hook": [0, 0, 1], "top": [0, 0, 2]}})",
                            0)
                   .crane);
}

TEST(SceneStateTest, TakesNullForWhatIsNotFinite) {
  EXPECT_TRUE(std::isnan(ReadSnapshot(R"({"step": 0, "time": 0, "qpos": [null]})", 1).qpos[0]));
}

TEST(SceneStateTest, RefusesAnotherModelsPositions) {
  EXPECT_THAT([] { ReadSnapshot(R"({"step": 0, "time": 0, "qpos": [1]})", 2); },
              ThrowsMessage<ControlError>(HasSubstr("1 positions, its model 2")));
}

TEST(SceneStateTest, RefusesWhatIsNoSnapshot) {
  for (const char* text :
       {"", "{", "[]", "3", "{}", R"({"step": 0, "time": 0})",
        R"({"step": 0, "time": 0, "qpos": 4})", R"({"step": 0, "time": "x", "qpos": []})",
        R"({"step": 0, "time": 0, "qpos": ["x"]})",
        R"({"step": 0, "time": 0, "qpos": [], "contacts": 7})",
        R"({"step": 0, "time": 0, "qpos": [], "contacts": [{"at": [1, 2], "force": [0, 0, 1]}]})",
        R"({"step": 0, "time": 0, "qpos": [], "remote": {"keys": 4}})"}) {
    EXPECT_THROW(ReadSnapshot(text, 0), ControlError) << text;
  }
}

}  // namespace
}  // namespace understudy::viewer
