#include "viewer/arguments.h"

#include <CLI/CLI.hpp>

#include "gmock/gmock.h"
#include "gtest/gtest.h"

namespace understudy::viewer {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

class ArgumentsTest : public testing::Test {
 protected:
  // "" for a command line that is fine, else what is said about it.
  std::string Refusal(const std::string& line) {
    CLI::App app("", "understudy");
    AddViewCommand(&app, &view_);
    AddPictureCommand(&app, &picture_);
    AddFilmCommand(&app, &film_);
    try {
      app.parse(line);
    } catch (const CLI::ParseError& error) {
      return error.what();
    }
    return "";
  }

  ViewArguments view_;
  PictureArguments picture_;
  FilmArguments film_;
};

TEST_F(ArgumentsTest, ReadsAWholeCommandLine) {
  ASSERT_EQ(Refusal("film run.mp4 --recording run.mcap --from 1 --to 2 --fps 60 --speed 0.1 "
                    "--size 640x480 --track trunk --azimuth 90 --show com,forces --overwrite"),
            "");
  EXPECT_EQ(film_.drawing.out, "run.mp4");
  EXPECT_EQ(film_.drawing.recording, "run.mcap");
  EXPECT_EQ(film_.drawing.size.width, 640);
  EXPECT_EQ(film_.drawing.size.height, 480);
  EXPECT_EQ(film_.drawing.camera.track, "trunk");
  EXPECT_EQ(film_.drawing.camera.azimuth, 90);
  EXPECT_TRUE(film_.drawing.show.com);
  EXPECT_TRUE(film_.drawing.show.forces);
  EXPECT_FALSE(film_.drawing.show.contacts);
  EXPECT_TRUE(film_.drawing.overwrite);
  EXPECT_EQ(film_.fps, 60);
  EXPECT_EQ(film_.from, 1);
}

TEST_F(ArgumentsTest, TakesAPointToLookAtBeforeTheFile) {
  ASSERT_EQ(Refusal("picture --lookat 0 -1 0.5 out.png"), "");
  EXPECT_THAT(picture_.drawing.camera.lookat, ElementsAre(0, -1, 0.5));
  EXPECT_EQ(picture_.drawing.out, "out.png");
}

TEST_F(ArgumentsTest, TakesWhatToShowBeforeTheFile) {
  ASSERT_EQ(Refusal("picture --show contacts out.png"), "");
  EXPECT_TRUE(picture_.drawing.show.contacts);
}

TEST_F(ArgumentsTest, RefusesAFileOfAnotherKind) {
  EXPECT_THAT(Refusal("picture out.jpg"), AllOf(HasSubstr(".png"), HasSubstr("out.jpg")));
  EXPECT_THAT(Refusal("film out.avi"), HasSubstr(".mp4 or .webp or .gif"));
  EXPECT_EQ(Refusal("film out.WEBP"), "");
  EXPECT_THAT(Refusal("film out"), HasSubstr(".mp4"));
}

TEST_F(ArgumentsTest, RefusesASizeThatIsNone) {
  for (const char* size :
       {"640", "640x", "x480", "640x480x3", "640*480", "8x8", "9000x480", "-640x480", "1e3x480"}) {
    EXPECT_THAT(Refusal("picture a.png --size " + std::string(size)), HasSubstr("WIDTHxHEIGHT"))
        << size;
  }
}

TEST_F(ArgumentsTest, NamesTheNearestThingToShow) {
  EXPECT_THAT(Refusal("view --show contact"),
              AllOf(HasSubstr("'contact'"), HasSubstr("did you mean 'contacts'")));
}

TEST_F(ArgumentsTest, RefusesATimeOfARunningRobot) {
  EXPECT_THAT(Refusal("picture a.png --at 3"), HasSubstr("--recording"));
  EXPECT_THAT(Refusal("film a.mp4 --from 3"), HasSubstr("--recording"));
}

TEST_F(ArgumentsTest, RefusesARecordingAndARobot) {
  EXPECT_THAT(Refusal("picture a.png --recording r.mcap --name dog"), HasSubstr("excludes"));
  EXPECT_THAT(Refusal("film a.mp4 --recording r.mcap --seconds 3"), HasSubstr("excludes"));
}

TEST_F(ArgumentsTest, RefusesTwoCamerasAtOnce) {
  EXPECT_THAT(Refusal("view --camera front --azimuth 3"), HasSubstr("excludes"));
  EXPECT_THAT(Refusal("view --lookat 0 0 0 --track trunk"), HasSubstr("excludes"));
}

TEST_F(ArgumentsTest, RefusesAFilmOfNoTimeOrNoPictures) {
  EXPECT_NE(Refusal("film a.mp4 --seconds 0"), "");
  EXPECT_NE(Refusal("film a.mp4 --fps 0"), "");
  EXPECT_NE(Refusal("film a.mp4 --speed 0"), "");
  EXPECT_NE(Refusal("film a.mp4 --speed nan"), "");
  EXPECT_NE(Refusal("film a.mp4 --recording r.mcap --to nan"), "");
}

}  // namespace
}  // namespace understudy::viewer
