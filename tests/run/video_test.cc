// The streams of two cameras, over the loopback of this machine.
#include "run/video.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include "tests/video/joined.h"

namespace understudy::run {
namespace {

using config::VideoSending;
using std::chrono::seconds;

constexpr double kHz = 10;
const std::vector<std::uint8_t> kFrame = {0, 0, 0, 1, 0x65, 42};

class VideoTest : public testing::Test {
 protected:
  VideoTest() : before_(spdlog::default_logger()) {
    auto log = std::make_shared<spdlog::logger>(
        "", std::make_shared<spdlog::sinks::ostream_sink_mt>(log_));
    log->set_pattern("%v");
    spdlog::set_default_logger(log);
  }
  ~VideoTest() override { spdlog::set_default_logger(before_); }

  // Camera 0 has no stream, camera 1 one to that port.
  static std::unique_ptr<Video> Make(int port, VideoSending sending,
                                     const std::string& interface = "lo") {
    std::vector<robot::CameraSpec> cameras(2);
    cameras[1].name = "front";
    cameras[1].video_port = port;
    cameras[1].video_hz = kHz;
    return std::make_unique<Video>(
        cameras, config::NetworkConfig{.interface = interface, .partition = "", .video = sending},
        nullptr);
  }
  void Watch(Video* video, seconds later = seconds(1)) { video->Watch(now_ += later); }

  std::chrono::steady_clock::time_point now_{seconds(100)};
  std::ostringstream log_;
  std::shared_ptr<spdlog::logger> before_;
};

TEST_F(VideoTest, WantsFramesOnlyWhileAProgramReadsThem) {
  auto reader = std::make_unique<test::Joined>();
  const auto video = Make(reader->port(), VideoSending::kJoined);
  EXPECT_FALSE(video->IsDue(1, 0));
  Watch(video.get());
  EXPECT_TRUE(video->IsDue(1, 0));
  EXPECT_FALSE(video->IsDue(0, 0));
  reader.reset();
  Watch(video.get());
  EXPECT_FALSE(video->IsDue(1, 0));
  EXPECT_EQ(log_.str(), "");
}

TEST_F(VideoTest, WantsThemAlwaysOrNeverWhereThatIsAsked) {
  const test::Joined reader;
  const auto never = Make(reader.port(), VideoSending::kOff);
  EXPECT_FALSE(never->possible());
  Watch(never.get());
  EXPECT_FALSE(never->IsDue(1, 0));
  const auto always = Make(9, VideoSending::kAlways);
  EXPECT_TRUE(always->possible());
  Watch(always.get());
  EXPECT_TRUE(always->IsDue(1, 0));
  EXPECT_FALSE(Make(0, VideoSending::kAlways)->possible());
}

TEST_F(VideoTest, WantsAsManyFramesASecondAsTheCameraHas) {
  const auto video = Make(9, VideoSending::kAlways);
  Watch(video.get());
  int frames = 0;
  for (int ms = 0; ms < 3000; ++ms) {
    if (!video->IsDue(1, ms / 1000.0)) continue;
    video->Begin(1, ms / 1000.0);
    ++frames;
  }
  EXPECT_NEAR(frames, 3 * kHz, 1);
  EXPECT_EQ(video->counts(1).missed, 0U);
}

TEST_F(VideoTest, CountsFramesThatWereDueMeanwhile) {
  const auto video = Make(9, VideoSending::kAlways);
  Watch(video.get());
  ASSERT_TRUE(video->IsDue(1, 2));
  video->Begin(1, 2);
  EXPECT_FALSE(video->IsDue(1, 2.05));
  ASSERT_TRUE(video->IsDue(1, 2.35));  // those of 2.1 and 2.2 are missed
  video->Begin(1, 2.35);
  EXPECT_EQ(video->counts(1).missed, 2U);
  EXPECT_FALSE(video->IsDue(1, 2.39));
  EXPECT_TRUE(video->IsDue(1, 2.41));
}

TEST_F(VideoTest, GoesOnAfterTimeHasBegunAnew) {
  const auto video = Make(9, VideoSending::kAlways);
  Watch(video.get());
  ASSERT_TRUE(video->IsDue(1, 60));
  video->Begin(1, 60);
  EXPECT_TRUE(video->IsDue(1, 0));
}

TEST_F(VideoTest, SendsAFrameWithItsInstantOnceAProgramReads) {
  const test::Joined reader;
  const auto video = Make(reader.port(), VideoSending::kJoined);
  video->Send(1, 0, kFrame);
  EXPECT_THAT(reader.Receive(0), testing::IsEmpty());
  Watch(video.get());
  video->Send(1, 1.5, kFrame);
  const std::vector<std::uint8_t> packet = reader.Receive();
  ASSERT_EQ(packet.size(), 14U);
  EXPECT_EQ(packet[4] << 24 | packet[5] << 16 | packet[6] << 8 | packet[7], 135'000);  // 90 kHz
  EXPECT_EQ(packet[13], 42);
  EXPECT_EQ(video->counts(1).sent, 1U);
  EXPECT_EQ(video->counts(1).unsent, 0U);
}

TEST_F(VideoTest, IsSentByOneRobotAloneUntilThatHasGone) {
  const test::Joined reader;
  auto first = Make(reader.port(), VideoSending::kJoined);
  const auto second = Make(reader.port(), VideoSending::kJoined);
  first->Watch(now_);
  for (int i = 0; i < 3; ++i) Watch(second.get());
  EXPECT_TRUE(first->IsDue(1, 0));
  EXPECT_FALSE(second->IsDue(1, 0));
  EXPECT_EQ(log_.str(), "the camera front sends no video to 230.1.1.1:" +
                            std::to_string(reader.port()) + " on lo: another robot sends there\n");
  first.reset();
  Watch(second.get());
  EXPECT_TRUE(second->IsDue(1, 0));
}

TEST_F(VideoTest, LeavesThePortToOthersOnceNobodyReadsItsOwn) {
  auto reader = std::make_unique<test::Joined>();
  const int port = reader->port();
  const auto first = Make(port, VideoSending::kJoined);
  Watch(first.get());
  ASSERT_TRUE(first->IsDue(1, 0));
  reader.reset();
  Watch(first.get());
  const test::Joined later(port);
  first->Send(1, 0, kFrame);
  EXPECT_THAT(later.Receive(0), testing::IsEmpty());
  const auto second = Make(port, VideoSending::kJoined);
  Watch(second.get());
  second->Send(1, 0, kFrame);
  EXPECT_EQ(later.Receive().size(), 14U);
}

TEST_F(VideoTest, SaysOnceWhyAnInterfaceTakesNone) {
  const auto video = Make(9, VideoSending::kAlways, "nowhere9");
  for (int i = 0; i < 3; ++i) Watch(video.get());
  EXPECT_FALSE(video->IsDue(1, 0));
  EXPECT_EQ(log_.str(),
            "the camera front sends no video to 230.1.1.1:9 on nowhere9: no video stream to "
            "230.1.1.1 on nowhere9: No such device\n");
}

TEST_F(VideoTest, SaysOnceHowManyFramesAreKeptWhereTheyAreFew) {
  const auto video = Make(9, VideoSending::kAlways);
  Watch(video.get());
  double time = 0;
  for (int second = 0; second < 30; ++second) {
    for (int i = 0; i < 4; ++i, time += 0.25) {  // of ten frames
      ASSERT_TRUE(video->IsDue(1, time));
      video->Begin(1, time);
      video->Send(1, time, kFrame);
    }
    Watch(video.get());
  }
  EXPECT_THAT(log_.str(),
              testing::MatchesRegex("the camera front sends [34]\\.[0-9] of 10.0 frames "
                                    "a second: this computer draws no more\n"));
}

TEST_F(VideoTest, RestsAfterAFrameThatCouldNotBeDrawn) {
  const auto video = Make(9, VideoSending::kAlways);
  Watch(video.get());
  ASSERT_TRUE(video->IsDue(1, 0));
  video->Begin(1, 0);
  video->Rest(now_);
  Watch(video.get(), seconds(9));
  EXPECT_FALSE(video->IsDue(1, 9));
  Watch(video.get(), seconds(2));
  EXPECT_TRUE(video->IsDue(1, 11));
}

}  // namespace
}  // namespace understudy::run
