#include "server/recordings.h"

#include <filesystem>
#include <fstream>
#include <map>

#include <mujoco/mujoco.h>
#include <nlohmann/json.hpp>

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "record/mcap_format.h"
#include "record/mcap_writer.h"
#include "record/truth.h"
#include "tests/support/temporary_folder.h"

namespace understudy::server {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::Pair;

constexpr char kSled[] = R"(<mujoco>
  <worldbody><body name="sled"><joint type="slide" axis="1 0 0"/><geom size="0.1"/></body></worldbody>
</mujoco>)";

constexpr std::uint64_t kStart = 1'700'000'000'000'000'000;  // ns

class RecordingsTest : public ::testing::Test {
 protected:
  // One of ten seconds in which the sled is at `time` [m], ten states a second.
  void Record(const std::string& name, const std::string& robot = "sled", bool finished = true,
              std::size_t joints = 1) {
    record::McapWriter writer(record::OutputFile(Here() / name, true), "ros2", "a test");
    writer.AddMetadata("understudy", {{"robot", robot}});
    const auto schema = writer.AddSchema(record::kTruthType, "ros2msg", record::kTruthText);
    const auto channel = writer.AddChannel(record::kTruthTopic, schema, "cdr", {});
    for (int i = 0; i <= 100; ++i) {
      const double time = 0.1 * i;
      record::BytesOut bytes;
      record::EncodeTruth({.step = 100 * i,
                           .time = time,
                           .qpos = std::vector(joints, time),
                           .tau = {10 * time},
                           .foot_force = {100 * time},
                           .crane_tension = 1000 * time},
                          &bytes);
      const std::uint64_t at = kStart + static_cast<std::uint64_t>(i) * 100'000'000;
      writer.Write(channel, at, at, bytes.span());
    }
    finished ? writer.Finish() : writer.Flush();
  }
  std::filesystem::path Here() const { return temp_.path() / "here"; }
  HttpReply Show(std::string_view name, const std::string& query = "") {
    const std::string target = "/recordings/" + std::string(name) + query;
    return dut_.Show({.method = "GET", .target = target}, name);
  }

  test::TemporaryFolder temp_;
  bool made_ = std::filesystem::create_directory(Here());
  std::string file_ = temp_.Write("model.xml", kSled).string();
  physics::SceneReader scene_{[this] {
    std::string why(300, '\0');
    return mjcf::ModelHandle(mj_loadXML(file_.c_str(), nullptr, why.data(), 300));
  }};
  Recordings dut_{Here(), &scene_, "sled"};
};

TEST_F(RecordingsTest, TellsTheFinishedFilesOfItsFolderNewestFirst) {
  Record("old.mcap");
  Record("new.mcap");
  std::filesystem::last_write_time(
      Here() / "old.mcap",
      std::filesystem::last_write_time(Here() / "new.mcap") - std::chrono::hours(1));
  std::ofstream(Here() / "notes.txt") << "x";
  std::ofstream(Here() / ".hidden.mcap") << "x";
  std::filesystem::create_symlink(Here() / "old.mcap", Here() / "link.mcap");
  std::filesystem::create_directory(Here() / "folder.mcap");
  const json told = json::parse(dut_.List().body);
  EXPECT_EQ(told["folder"], Here().string());
  ASSERT_EQ(told["recordings"].size(), 2u);
  EXPECT_EQ(told["recordings"][0]["name"], "new.mcap");
  EXPECT_EQ(told["recordings"][1]["bytes"], std::filesystem::file_size(Here() / "old.mcap"));
  const double hour = told["recordings"][0]["written"].get<double>() -
                      told["recordings"][1]["written"].get<double>();
  EXPECT_NEAR(hour, 3600, 1);
}

TEST_F(RecordingsTest, SaysInTheListWhichItDoesNotPlayAndWhy) {
  Record("mine.mcap");
  Record("other.mcap", "go2");
  Record("cut.mcap", "sled", false);
  const auto why_not = [this] {
    std::map<std::string, std::string> found;
    const json told = json::parse(dut_.List().body);
    for (const json& recording : told["recordings"]) {
      found[recording["name"]] = recording.value("why_not", "");
    }
    return found;
  };
  EXPECT_THAT(why_not(),
              ElementsAre(Pair("cut.mcap", HasSubstr("is not finished")), Pair("mine.mcap", ""),
                          Pair("other.mcap", HasSubstr("of the robot 'go2'"))));
  // A file that has changed is looked at again, one that has gone is left out.
  Record("cut.mcap");
  std::filesystem::remove(Here() / "mine.mcap");
  EXPECT_THAT(why_not(), ElementsAre(Pair("cut.mcap", ""), Pair("other.mcap", Not(""))));
}

TEST_F(RecordingsTest, ListsWithoutAWordWhatItWouldHaveToReadWhole) {
  Record("other.mcap", "go2");
  {
    std::fstream file(Here() / "other.mcap", std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(-static_cast<int>(record::kMcapFooter + record::kMcapMagic.size()), std::ios::end);
    file.write("\0\0\0\0\0\0\0\0", 8);  // where the summary begins
  }
  const json told = json::parse(dut_.List().body);
  EXPECT_FALSE(told["recordings"][0].contains("why_not"));
  EXPECT_EQ(Show("other.mcap").status, 409u);
}

TEST_F(RecordingsTest, PutsTheBodiesWhereTheRecordedJointsHadThem) {
  Record("run.mcap");
  const json span = json::parse(Show("run.mcap").body);
  EXPECT_EQ(span, json::parse(R"({"from": 0, "to": 10})"));
  const json told = json::parse(Show("run.mcap", "?from=2&to=4&hz=10").body);
  ASSERT_EQ(told["times"].size(), 21u);
  EXPECT_NEAR(told["times"][0].get<double>(), 2, 1e-9);
  EXPECT_NEAR(told["times"][20].get<double>(), 4, 1e-9);
  EXPECT_NEAR(told["bodies"][7][1][0].get<double>(), 2.7, 1e-6);
  EXPECT_EQ(told["bodies"][7][1].size(), 7u);
  EXPECT_NEAR(told["qpos"][7][0].get<double>(), 2.7, 1e-6);
  EXPECT_NEAR(told["tau"][7][0].get<double>(), 27, 1e-5);
  EXPECT_NEAR(told["feet"][7][0].get<double>(), 270, 1e-4);
  EXPECT_NEAR(told["crane_tension"][7].get<double>(), 2700, 1e-3);
  EXPECT_EQ(json::parse(Show("run.mcap", "?from=2&to=4&hz=2").body)["times"].size(), 5u);
}

TEST_F(RecordingsTest, NothingButItsRecordingsCanBeReached) {
  Record("run.mcap");
  std::filesystem::copy(Here() / "run.mcap", temp_.path() / "out.mcap");
  std::filesystem::create_symlink(temp_.path() / "out.mcap", Here() / "link.mcap");
  for (const char* name : {"../out.mcap", "link.mcap", "..%2Fout.mcap", "./run.mcap", "", ".mcap",
                           "run.mcap/", "/etc/passwd", "none.mcap", "run.mcap\0.mcap"}) {
    EXPECT_EQ(Show(name).status, std::string_view(name) == "run.mcap" ? 200u : 404u) << name;
  }
  EXPECT_EQ(Recordings().Show({.method = "GET", .target = "/"}, "run.mcap").status, 404u);
}

TEST_F(RecordingsTest, RefusesWhatIsNoTimeOrTooMuchOfIt) {
  Record("run.mcap");
  for (const char* query : {"?from=1", "?to=1", "?from=3&to=1", "?from=0&to=10.1", "?from=-1&to=1",
                            "?from=nan&to=1", "?from=0&to=inf", "?from=x&to=1", "?from=0&to=1&hz=0",
                            "?from=0&to=1&hz=61", "?from=0&to=1&hz=x"}) {
    EXPECT_EQ(Show("run.mcap", query).status, 400u) << query;
  }
}

TEST_F(RecordingsTest, SaysWhyAFileCannotBePlayed) {
  const auto why = [&](const std::string& name) {
    const HttpReply reply = Show(name, "?from=0&to=1");
    EXPECT_EQ(reply.status, 409u);
    return json::parse(reply.body)["error"].get<std::string>();
  };
  Record("cut.mcap", "sled", false);
  EXPECT_THAT(why("cut.mcap"), HasSubstr("is not finished"));
  Record("other.mcap", "go2");
  EXPECT_THAT(why("other.mcap"), HasSubstr("of the robot 'go2', and this is sled"));
  Record("joints.mcap", "sled", true, 2);
  EXPECT_THAT(why("joints.mcap"), HasSubstr("2 positions"));
  std::string bytes;
  {
    std::ifstream in(Here() / "joints.mcap", std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(in), {});
  }
  bytes[bytes.size() / 3] = static_cast<char>(bytes[bytes.size() / 3] + 1);
  std::ofstream(Here() / "bad.mcap", std::ios::binary) << bytes;
  EXPECT_NE(why("bad.mcap"), "");
}

}  // namespace
}  // namespace understudy::server
