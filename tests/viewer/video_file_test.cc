#include "viewer/video_file.h"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "base/errors.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/support/temporary_folder.h"

namespace understudy::viewer {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr PictureSize kSize{.width = 32, .height = 16};

class VideoFileTest : public testing::Test {
 protected:
  VideoFileTest() { std::signal(SIGPIPE, SIG_IGN); }
  ~VideoFileTest() override { ::setenv("PATH", path_.c_str(), 1); }

  static Image Picture() {
    return {.width = 32, .height = 16, .rgb = std::vector<std::uint8_t>(3U * 32U * 16U, 90)};
  }
  auto Files() const {
    return std::distance(std::filesystem::directory_iterator(folder_.path()), {});
  }

  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "a.mp4";
  std::string path_ = std::getenv("PATH");
};

TEST_F(VideoFileTest, IsWholeOnceFinished) {
  VideoFile video(file_, kSize, 10);
  for (int i = 0; i < 5; ++i) video.Add(Picture());
  EXPECT_FALSE(std::filesystem::exists(file_));
  video.Finish();
  EXPECT_GT(std::filesystem::file_size(file_), 500U);
  EXPECT_EQ(Files(), 1);
}

TEST_F(VideoFileTest, IsOfTheKindThatItsNameEndsWith) {
  constexpr const char* kBegins[][2] = {
      {"a.webp", "RIFF"}, {"a.GIF", "GIF8"}, {"b.mp4", "\0\0\0 ftyp"}};
  for (const auto& [name, begins] : kBegins) {
    VideoFile video(folder_.path() / name, kSize, 10);
    for (int i = 0; i < 5; ++i) video.Add(Picture());
    video.Finish();
    std::string head(4, ' ');
    std::ifstream(folder_.path() / name).read(head.data(), 4);
    EXPECT_EQ(head, std::string(begins, 4)) << name;
  }
  EXPECT_THROW(VideoFile(folder_.path() / "a.avi", kSize, 10), SetupError);
}

TEST_F(VideoFileTest, LeavesNothingThatWasNotFinished) {
  {
    VideoFile video(file_, kSize, 10);
    video.Add(Picture());
  }
  EXPECT_EQ(Files(), 0);
}

TEST_F(VideoFileTest, TellsWhatFfmpegSays) {
  EXPECT_THAT(
      [&] {
        VideoFile video(folder_.path() / "no" / "a.mp4", kSize, 10);
        for (int i = 0; i < 10'000; ++i) video.Add(Picture());
        video.Finish();
      },
      ThrowsMessage<SetupError>(HasSubstr("No such file or directory")));
}

TEST_F(VideoFileTest, TellsWhichEncoderIsMissingAndWhatElseThereIs) {
  const std::filesystem::path ffmpeg =
      folder_.Write("ffmpeg", "#!/bin/sh\necho \"Unknown encoder 'libwebp_anim'\" >&2\nexit 1\n");
  std::filesystem::permissions(ffmpeg, std::filesystem::perms::owner_all);
  ::setenv("PATH", folder_.path().c_str(), 1);
  EXPECT_THAT(
      [&] {
        VideoFile video(folder_.path() / "a.webp", kSize, 10);
        video.Add(Picture());
        video.Finish();
      },
      ThrowsMessage<SetupError>(
          testing::AllOf(HasSubstr("no encoder for .webp"), HasSubstr("libwebp_anim"),
                         HasSubstr("apt-get install ffmpeg, or name a film .mp4 or .gif"))));
}

TEST_F(VideoFileTest, TakesANameThatLooksLikeAProtocol) {
  const std::filesystem::path file = folder_.path() / "12:30.mp4";
  const std::filesystem::path here = std::filesystem::current_path();
  std::filesystem::current_path(folder_.path());
  VideoFile video("12:30.mp4", kSize, 10);
  video.Add(Picture());
  video.Finish();
  std::filesystem::current_path(here);
  EXPECT_TRUE(std::filesystem::exists(file));
}

// As ffmpeg does when there is room for the pictures and none for the index behind them.
TEST_F(VideoFileTest, BelievesWordsMoreThanAnExitCode) {
  const std::filesystem::path program = folder_.Write(
      "ffmpeg", "#!/bin/sh\n/bin/cat > /dev/null\necho 'No space left on device' >&2\n");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  ::setenv("PATH", folder_.path().c_str(), 1);
  VideoFile video(file_, kSize, 10);
  video.Add(Picture());
  EXPECT_THAT([&] { video.Finish(); },
              ThrowsMessage<SetupError>(HasSubstr("ffmpeg says: No space left on device")));
  EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(VideoFileTest, LeavesNothingWhereItsNameIsAFolders) {
  std::filesystem::create_directory(file_);
  VideoFile video(file_, kSize, 10);
  video.Add(Picture());
  EXPECT_THAT([&] { video.Finish(); }, ThrowsMessage<SetupError>(HasSubstr("cannot write")));
  EXPECT_EQ(Files(), 1);
}

TEST_F(VideoFileTest, NamesThePackageWhereThereIsNoFfmpeg) {
  ::setenv("PATH", folder_.path().c_str(), 1);
  EXPECT_THAT([&] { VideoFile(file_, kSize, 10); },
              ThrowsMessage<SetupError>(HasSubstr("apt-get install ffmpeg")));
}

}  // namespace
}  // namespace understudy::viewer
