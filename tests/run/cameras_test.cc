// The cameras of a robot, with a program of the test that draws.
#include "run/cameras.h"

#include <chrono>
#include <filesystem>
#include <future>
#include <memory>
#include <sstream>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include "assembly/make_world.h"
#include "tests/support/eventually.h"
#include "tests/support/fake_port.h"
#include "tests/support/fixture_robot.h"
#include "tests/support/manual_clock.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"
#include "tests/video/joined.h"

namespace understudy::run {
namespace {

using services::Picture;
using enum Picture::Outcome;

class CamerasTest : public test::MujocoTest {
 protected:
  CamerasTest() : before_(spdlog::default_logger()) {
    auto log = std::make_shared<spdlog::logger>(
        "", std::make_shared<spdlog::sinks::ostream_sink_mt>(log_));
    log->set_pattern("%v");
    spdlog::set_default_logger(log);
    robot::CameraSpec front, back;
    front.name = "front";
    front.service = "videohub";
    front.depth = {0.25, 8};
    back.name = "back";
    back.service = "back_videohub";
    back.quality = 40;
    back.video_port = reader_.port();
    config_.robots[0].spec.cameras = {front, back};
    world_ = assembly::MakeWorld(
        test::FixtureWorld(config_.robots[0].spec, config_.physics.timestep), config_,
        [this](std::size_t) { return emulator::Ports{&port_}; }, &inbox_);
    Start("draws.py", "socket");
  }
  ~CamerasTest() override { spdlog::set_default_logger(before_); }

  void Start(const std::string& program, const std::string& socket, bool holds_steps = false,
             config::VideoSending video = config::VideoSending::kOff) {
    cameras_.reset();
    cameras_ = std::make_unique<Cameras>(
        *world_, 0, std::filesystem::path(UNDERSTUDY_SOURCE_DIR) / "tests/run/data" / program,
        folder_.path() / socket,
        config::NetworkConfig{.interface = "lo", .partition = "", .video = video}, nullptr,
        holds_steps);
  }
  void Step() {
    world_->Tick(clock_.Now());
    cameras_->After({.world = *world_, .pacer = pacer_, .ticked = true});
  }
  // Waits for what is next; the text of its picture.
  std::pair<Picture, std::string> Take() {
    EXPECT_TRUE(test::Eventually([this] { return cameras_->Front() != nullptr; }));
    Picture picture = cameras_->Front() == nullptr ? Picture{} : *cameras_->Front();
    if (cameras_->Front() != nullptr) cameras_->Pop();
    return {picture,
            picture.jpeg == nullptr ? "" : std::string(picture.jpeg->begin(), picture.jpeg->end())};
  }
  std::string Taken() { return Take().second; }
  void Fault(std::string_view component, std::string_view kind, double by = -1) {
    ASSERT_TRUE(
        world_->robot(0).SetFault(component, kind, by < 0 ? nullptr : &by, {}, world_->time()));
  }

  void StepAndPop(int steps) {
    for (int i = 0; i < steps; ++i) {
      Step();
      if (cameras_->Front() != nullptr) cameras_->Pop();
    }
  }
  void StartFilming() { Start("draws.py", "film", false, config::VideoSending::kJoined); }
  // Steps until a frame of the back camera's video comes; its text.
  std::string Film() {
    std::vector<std::uint8_t> packet;
    EXPECT_TRUE(test::Eventually([&] {
      StepAndPop(20);
      packet = reader_.Receive(0);
      return !packet.empty();
    }));
    return packet.size() < 13 ? "" : std::string(packet.begin() + 13, packet.end());
  }

  const test::Joined reader_;
  config::Config config_ = test::FixtureConfig();
  test::FakePort port_;
  test::ManualClock clock_;
  time::Pacer pacer_{&clock_, time::Clock::Time(1'000'000), 1};
  emulator::Inbox inbox_;
  test::TemporaryFolder folder_;
  std::ostringstream log_;
  std::shared_ptr<spdlog::logger> before_;
  std::unique_ptr<emulator::World> world_;
  std::unique_ptr<Cameras> cameras_;
};

TEST_F(CamerasTest, DrawNothingThatIsNotOrdered) {
  for (int i = 0; i < 10; ++i) Step();
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "socket"));
  EXPECT_EQ(cameras_->Begin("sport"), 0U);
}

TEST_F(CamerasTest, ShowTheStateAfterTheStepInWhichTheyAreAsked) {
  for (int i = 0; i < 6; ++i) Step();
  const auto order = cameras_->Begin("videohub");
  Step();
  Step();
  const auto [picture, text] = Take();
  EXPECT_EQ(picture.order, order);
  EXPECT_EQ(picture.outcome, kDrawn);
  EXPECT_EQ(text, "front 90 1.00 0.007");
}

TEST_F(CamerasTest, HoldTheStepsOfAClockOfProgramsUntilThePictureIsDrawn) {
  cameras_->Begin("videohub");
  Step();
  EXPECT_TRUE(cameras_->AllowsStep());
  Start("draws.py", "another", /*holds_steps=*/true);
  EXPECT_TRUE(cameras_->AllowsStep());
  cameras_->Begin("videohub");
  Step();
  const bool allows = cameras_->AllowsStep();
  EXPECT_EQ(allows, allows && cameras_->Front() != nullptr);
  EXPECT_TRUE(test::Eventually([this] { return cameras_->AllowsStep(); }));
  EXPECT_EQ(Taken(), "front 90 1.00 0.002");
  EXPECT_TRUE(cameras_->AllowsStep());
}

TEST_F(CamerasTest, TakeTurnsAndShareWhatIsOrderedMeanwhile) {
  const auto first = cameras_->Begin("videohub");
  EXPECT_EQ(cameras_->Begin("videohub"), first);
  Step();
  const auto second = cameras_->Begin("videohub");
  EXPECT_NE(second, first);
  EXPECT_EQ(cameras_->Begin("videohub"), second);
  const auto third = cameras_->Begin("back_videohub");
  Step();
  EXPECT_EQ(Taken(), "front 90 1.00 0.001");
  Step();
  const auto [back, text] = Take();
  EXPECT_EQ(back.order, third);
  EXPECT_EQ(text, "back 40 1.00 0.003");
  Step();
  EXPECT_EQ(Taken(), "front 90 1.00 0.004");
}

TEST_F(CamerasTest, SeeLessLightAndTheSamePictureAndNoneAndNoiseByFault) {
  Fault("camera.front", "dark", 0.75);
  cameras_->Begin("videohub");
  Step();
  EXPECT_EQ(Taken(), "front 90 0.25 0.001");
  Fault("camera.front", "frozen");
  cameras_->Begin("videohub");
  Step();
  EXPECT_EQ(Taken(), "front 90 0.25 0.001");
  cameras_->Begin("back_videohub");
  Step();
  EXPECT_EQ(Taken(), "back 40 1.00 0.003");
  Fault("camera.front", "lossy", 1);
  cameras_->Begin("videohub");
  Step();
  EXPECT_EQ(Take().first.outcome, kLost);
  Fault("camera.back", "noisy", 12);
  cameras_->Begin("back_videohub");
  Step();
  EXPECT_EQ(Taken(), "back 40 1.00 0.005 noise 12");
  Fault("camera.front", "none");
  cameras_->Begin("videohub");
  Step();
  EXPECT_EQ(Taken(), "front 90 1.00 0.006");
}

TEST_F(CamerasTest, ShowTheSamePictureToWhoLooksAndToTheService) {
  std::future<Picture> first = cameras_->Look(0, false), second = cameras_->Look(0, false);
  cameras_->Begin("videohub");
  Step();
  EXPECT_EQ(Taken(), "front 90 1.00 0.001");
  for (std::future<Picture>* look : {&first, &second}) {
    const Picture seen = look->get();
    EXPECT_EQ(std::string(seen.jpeg->begin(), seen.jpeg->end()), "front 90 1.00 0.001");
  }
  EXPECT_TRUE(cameras_->news().Answer());
}

TEST_F(CamerasTest, ShowALookThatComesLaterALaterPicture) {
  std::future<Picture> early = cameras_->Look(1, false);
  Step();
  std::future<Picture> late = cameras_->Look(1, false);
  Take();
  EXPECT_EQ(late.wait_for(std::chrono::seconds(0)), std::future_status::timeout);
  Step();
  EXPECT_EQ(Taken(), "back 40 1.00 0.002");
  const Picture seen = late.get();
  EXPECT_EQ(std::string(seen.jpeg->begin(), seen.jpeg->end()), "back 40 1.00 0.002");
  EXPECT_EQ(early.get().outcome, kDrawn);
}

TEST_F(CamerasTest, MeasureDepthForWhoLooksForIt) {
  std::future<Picture> without = cameras_->Look(0, false);
  Step();
  Take();
  EXPECT_EQ(without.get().depth, nullptr);
  std::future<Picture> of_another = cameras_->Look(1, true), with = cameras_->Look(0, true);
  for (int i = 0; i < 2; ++i) {
    Step();
    Take();
  }
  const Picture seen = with.get();
  ASSERT_NE(seen.depth, nullptr);
  EXPECT_EQ(std::string(seen.depth->begin(), seen.depth->end()),
            "depth of front within [0.25, 8.0]");
  EXPECT_EQ(std::string(seen.jpeg->begin(), seen.jpeg->end()).substr(0, 5), "front");
}

TEST_F(CamerasTest, FilmWithTheFaultsOfTheirPictures) {
  StartFilming();
  EXPECT_THAT(Film(), testing::StartsWith("back 40 1.00 "));
  Fault("camera.back", "dark", 0.75);
  std::string last;
  EXPECT_TRUE(test::Eventually([&] { return (last = Film()).starts_with("back 40 0.25 "); }));
  Fault("camera.back", "frozen");
  const std::string frozen = Film();
  for (int i = 0; i < 3; ++i) EXPECT_EQ(Film(), frozen);
  EXPECT_GE(cameras_->video(1).sent, 4U);
  EXPECT_EQ(cameras_->video(0).sent, 0U);
}

TEST_F(CamerasTest, FilmNothingWhileTheCameraLosesItsPictures) {
  StartFilming();
  Film();
  Fault("camera.back", "lossy", 1);
  EXPECT_TRUE(test::Eventually([&] {
    Step();
    const bool lost = cameras_->Front() != nullptr && cameras_->Front()->outcome == kLost;
    if (cameras_->Front() != nullptr) cameras_->Pop();
    return lost;
  }));
  const auto sent = cameras_->video(1).sent;
  StepAndPop(300);
  EXPECT_EQ(cameras_->video(1).sent, sent);
  while (!reader_.Receive(0).empty()) {
  }
  Fault("camera.back", "none");
  EXPECT_THAT(Film(), testing::StartsWith("back 40 1.00 "));
}

TEST_F(CamerasTest, SayOnceWhyThereIsNoPicture) {
  Start("draws.py", "dark");
  for (int i = 0; i < 3; ++i) {
    cameras_->Begin("videohub");
    Step();
    EXPECT_EQ(Take().first.outcome, kFailed);
  }
  EXPECT_EQ(log_.str(), "the cameras give no pictures: no OpenGL\n");
}

TEST_F(CamerasTest, NameTheProgramThatIsMissing) {
  Start("none", "socket");
  cameras_->Begin("videohub");
  Step();
  EXPECT_EQ(Take().first.outcome, kFailed);
  EXPECT_THAT(log_.str(), testing::HasSubstr("data/none cannot be run: No such file"));
}

TEST_F(CamerasTest, EndWhileAPictureIsDrawn) {
  cameras_->Begin("videohub");
  Step();
  cameras_.reset();
  EXPECT_EQ(log_.str(), "");
}

}  // namespace
}  // namespace understudy::run
