#include "viewer/film_maker.h"

#include "gtest/gtest.h"
#include "viewer/headless_gl.h"
#include "viewer_test.h"

namespace understudy::viewer {
namespace {

class FilmMakerTest : public test::MujocoTest {
 protected:
  FilmMaker Make(const FilmMaker::Plan& plan) {
    return {&stage_, {},
            {},      {.width = 16, .height = 16},
            plan,    [this](const Image&) {
              times_.push_back(stage_.state().time); }};
  }

  std::unique_ptr<HeadlessGl> gl_ = MakeHeadlessGl("egl");
  Stage stage_{BallModel()};
  std::vector<double> times_;  // of the pictures
};

TEST_F(FilmMakerTest, DrawsAtEvenTimesWhateverTheStatesAre) {
  FilmMaker maker = Make({.fps = 10, .seconds = 1});
  double time = 100;
  for (int i = 0; maker.Add(BallAt(0, time)); ++i) time += i % 3 == 0 ? 0.07 : 0.02;
  ASSERT_EQ(times_.size(), 10U);
  for (std::size_t i = 0; i < times_.size(); ++i) {
    EXPECT_NEAR(times_[i], 100 + 0.1 * static_cast<double>(i), 1e-9);
  }
}

TEST_F(FilmMakerTest, SlowsDown) {
  FilmMaker maker = Make({.fps = 10, .speed = 0.5, .seconds = 2});
  for (double time = 0; maker.Add(BallAt(0, time));) time += 0.01;
  ASSERT_EQ(times_.size(), 20U);
  EXPECT_NEAR(times_[19], 0.95, 1e-9);
}

TEST_F(FilmMakerTest, WaitsWhileTimeStandsStill) {
  FilmMaker maker = Make({.fps = 10, .seconds = 1});
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(maker.Add(BallAt(0, 5)));
  EXPECT_EQ(times_.size(), 1U);
  EXPECT_EQ(maker.seconds(), 0.1);
}

TEST_F(FilmMakerTest, LeavesOutAStateThatIsNotLater) {
  FilmMaker maker = Make({.fps = 10, .seconds = 1});
  EXPECT_TRUE(maker.Add(BallAt(0, 5)));
  EXPECT_TRUE(maker.Add(BallAt(0, 4)));
  EXPECT_TRUE(maker.Add(BallAt(0, 5.1)));
  EXPECT_EQ(times_.size(), 2U);
}

TEST_F(FilmMakerTest, PutsTheRobotBetweenTwoStates) {
  const SceneState between = Between(stage_.model(), BallAt(0, 1), BallAt(0.1, 2), 0.25);
  EXPECT_NEAR(between.qpos[0], 0.025, 1e-12);
  EXPECT_NEAR(between.time, 1.25, 1e-12);
}

TEST_F(FilmMakerTest, TurnsAlongTheArcBetweenTwoStates) {
  SceneState turned = BallAt(0, 2);
  turned.qpos[3] = 0;
  turned.qpos[6] = 1;  // half a turn about z
  const SceneState between = Between(stage_.model(), BallAt(0, 1), turned, 0.5);
  EXPECT_NEAR(between.qpos[3], std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(std::abs(between.qpos[6]), std::sqrt(0.5), 1e-9);
}

TEST_F(FilmMakerTest, DoesNotFlyThroughAReset) {
  EXPECT_EQ(Between(stage_.model(), BallAt(5, 1), BallAt(0, 2), 0.5).qpos[0], 5);
}

}  // namespace
}  // namespace understudy::viewer
