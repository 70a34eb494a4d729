#include "record/csv.h"

#include <fstream>
#include <iterator>
#include <sstream>

#include <gmock/gmock.h>

#include "tests/record/runs.h"

namespace understudy::record {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::ThrowsMessage;

class CsvTest : public RunsTest {
 protected:
  std::vector<std::string> Lines(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) {
      EXPECT_EQ(line.back(), '\r');
      line.pop_back();
      lines.push_back(line);
    }
    return lines;
  }
  std::vector<std::string> Written(const RunChoice& choice, const McapReader* second = nullptr,
                                   double shift = 0) {
    WriteCsv(first_, second, shift, choice, File("a.csv"));
    return Lines(File("a.csv"));
  }

  McapReader first_{
      Make("first.mcap",
           {.seconds = 2,
            .q = [](double t) { return t; },
            .events = {{.step = 500, .time = 0.5, .kind = "push", .text = "push \"it\", now"},
                       {.step = 500, .time = 0.5, .kind = "reset", .text = "reset"}}})};
};

TEST_F(CsvTest, HasAHeaderWithUnitsAndARowForEachTime) {
  const auto lines = Written({.fields = {"q", "tau"}, .signals = {"rt/lowstate:tick"}});
  ASSERT_THAT(lines, SizeIs(1 + 201));
  EXPECT_EQ(lines[0],
            "time [s],base height [m],base roll [°],base pitch [°],base yaw [°],FR_hip q [rad],"
            "FR_hip tau [N·m],rt/lowstate:tick,events");
  EXPECT_EQ(lines[1], "0.000000,0.3,0,0,0,0,0,0,");
  EXPECT_EQ(lines[26], "0.250000,0.3,0,0,0,0.25,0,0,");
  EXPECT_EQ(lines[51], "0.500000,0.3,0,0,0,0.5,0,0,\"push: push \"\"it\"\", now; reset: reset\"");
}

TEST_F(CsvTest, HasAPart) {
  const auto lines = Written({.fields = {"q"}, .from = 1, .to = 1.1});
  ASSERT_THAT(lines, SizeIs(1 + 11));
  EXPECT_THAT(lines[1], HasSubstr("1.000000,"));
  EXPECT_THAT(lines[11], HasSubstr("1.100000,"));
}

// Another's recording has no names of motors: slots tell which is which.
TEST_F(CsvTest, HasTwoOneAfterTheOther) {
  const McapReader second(
      Make("second.mcap", {.seconds = 1, .q = [](double) { return 7.0; }, .named = false}));
  const auto lines = Written({.fields = {"q"}}, &second, 0.25);
  ASSERT_THAT(lines, SizeIs(1 + 201 + 101));
  EXPECT_THAT(lines[0], HasSubstr("recording,time [s],base height [m]"));
  EXPECT_EQ(lines[1], "first.mcap,0.000000,0.3,0,0,0,0,");
  EXPECT_EQ(lines[202], "second.mcap,0.250000,0.3,0,0,0,7,");
  EXPECT_THAT(Written({.fields = {"q"}, .to = 0.5}, &second, 0.25), SizeIs(1 + 51 + 26));
  EXPECT_THAT([&] { Written({.to = 0.5}, &second, 0.5); },
              ThrowsMessage<RecordError>(HasSubstr("leaves nothing in common")));
}

TEST_F(CsvTest, LeavesNothingHalfWritten) {
  EXPECT_THAT([&] { Written({.motors = {"FR_hop"}}); },
              ThrowsMessage<RecordError>(HasSubstr("did you mean 'FR_hip'?")));
  EXPECT_THAT([&] { WriteCsv(first_, nullptr, 0, {}, File("none") / "a.csv"); },
              ThrowsMessage<RecordError>(HasSubstr("cannot be written: No such file")));
  EXPECT_THAT([&] { WriteCsv(first_, nullptr, 0, {}, "/dev/full/a.csv"); },
              ThrowsMessage<RecordError>(HasSubstr("cannot be written")));
  const auto files = std::distance(std::filesystem::directory_iterator(folder_.path()), {});
  EXPECT_EQ(files, 1);
}

}  // namespace
}  // namespace understudy::record
