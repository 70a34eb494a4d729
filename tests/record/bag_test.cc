#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <sqlite3.h>
#include <zstd.h>

#include "record/recording_reader.h"
#include "tests/record/mcap_files.h"

namespace understudy::record {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class BagTest : public McapFilesTest {
 protected:
  static void Run(const std::filesystem::path& file, const std::string& statements) {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
    char* why = nullptr;
    EXPECT_EQ(sqlite3_exec(database, statements.c_str(), nullptr, nullptr, &why), SQLITE_OK) << why;
    sqlite3_free(why);
    sqlite3_close(database);
  }
  static constexpr char kTables[] =
      "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
      "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);"
      "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, "
      "timestamp INTEGER NOT NULL, data BLOB NOT NULL);";
  // Two topics with messages at 100, 101, ... from `first` on.
  std::filesystem::path Bag(const std::string& name = "run.db3", int first = 0, int messages = 4) {
    const std::filesystem::path file = File(name);
    std::string text = kTables;
    text +=
        "INSERT INTO topics VALUES(7, '/a', 'a_msgs/msg/A', 'cdr', '');"
        "INSERT INTO topics VALUES(900000, '/b', 'a_msgs/msg/A', 'cdr', '');";
    for (int i = first; i < first + messages; ++i) {
      text += "INSERT INTO messages(topic_id, timestamp, data) VALUES(" +
              std::string(i % 2 == 0 ? "7" : "900000") + ", " + std::to_string(100 + i) +
              ", CAST('message " + std::to_string(i) + "' AS BLOB));";
    }
    Run(file, text);
    return file;
  }
  // As `ros2 bag record --compression-mode file` leaves it: FILE.zstd alone.
  static void Pack(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    const std::string plain{std::istreambuf_iterator<char>(in), {}};
    std::string packed(ZSTD_compressBound(plain.size()), '\0');
    packed.resize(ZSTD_compress(packed.data(), packed.size(), plain.data(), plain.size(), 1));
    std::ofstream(file.string() + ".zstd", std::ios::binary) << packed;
    std::filesystem::remove(file);
  }
  void WriteText(const std::string& name, const std::string& text) {
    std::ofstream(File(name), std::ios::binary) << text;
  }
  // What reading it to its end comes to: "" when all of it could be read.
  static std::string Reading(const std::filesystem::path& file) {
    try {
      const auto reader = OpenRecording(file);
      reader->ReadMessages([](const McapChannel&, const McapMessage&) { return true; });
      return {};
    } catch (const RecordError& error) {
      return error.what();
    }
  }
  static std::vector<std::string> Told(const RecordingReader& reader, std::uint64_t from = 0,
                                       std::uint64_t to = ~std::uint64_t{0}) {
    std::vector<std::string> told;
    reader.ReadMessages(from, to, [&](const McapChannel& channel, const McapMessage& message) {
      told.push_back(std::to_string(message.log_time) + " " + channel.topic + " " +
                     TextOf(message.data));
      return true;
    });
    return told;
  }
};

TEST_F(BagTest, ReadsWhatABagHolds) {
  const auto reader = OpenRecording(Bag());
  const McapContents& contents = reader->contents();
  EXPECT_EQ(contents.messages, 4U);
  EXPECT_EQ(contents.first_time, 100U);
  EXPECT_EQ(contents.last_time, 103U);
  ASSERT_EQ(contents.channels.size(), 2U);
  const McapChannel& channel = contents.channels.begin()->second;
  EXPECT_EQ(channel.topic, "/a");
  EXPECT_EQ(reader->SchemaOf(channel)->name, "a_msgs/msg/A");
  EXPECT_EQ(contents.counts.at(channel.id), 2U);
  EXPECT_THAT(Told(*reader), ElementsAre("100 /a message 0", "101 /b message 1", "102 /a message 2",
                                         "103 /b message 3"));
  EXPECT_THAT(Told(*reader, 101, 102), ElementsAre("101 /b message 1", "102 /a message 2"));
}

TEST_F(BagTest, KnowsABagByItsContentWhateverItsName) {
  EXPECT_EQ(OpenRecording(Bag("run.bag"))->contents().messages, 4U);
}

TEST_F(BagTest, ReadsAFoldersFilesInTheOrderOfTime) {
  Bag("bag_1.db3", 2, 2);
  Bag("bag_0.db3", 0, 2);
  // Older bags name their files from the folder above.
  WriteText("metadata.yaml",
            "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: sqlite3\n"
            "  relative_file_paths:\n    - bag_1.db3\n    - some_bag/bag_0.db3\n"
            "  compression_format: \"\"\n  compression_mode: \"\"\n");
  const auto reader = OpenRecording(File("."));
  EXPECT_EQ(reader->contents().channels.size(), 2U);
  EXPECT_EQ(reader->contents().first_time, 100U);
  EXPECT_EQ(reader->contents().last_time, 103U);
  EXPECT_EQ(reader->contents().counts.begin()->second, 2U);
  EXPECT_THAT(Told(*reader), ElementsAre("100 /a message 0", "101 /b message 1", "102 /a message 2",
                                         "103 /b message 3"));
}

TEST_F(BagTest, AFoldersFilesMayBeOfMcap) {
  Written();
  WriteText("metadata.yaml", "rosbag2_bagfile_information: {relative_file_paths: [run.mcap]}\n");
  const auto reader = OpenRecording(File("."));
  EXPECT_EQ(reader->contents().messages, 10U);
  EXPECT_EQ(reader->contents().metadata.at("about").at("robot"), "go2");
}

// A split recording keeps its names apart; folders put together by hand need not.
TEST_F(BagTest, CompressedFilesOfOneNameStayTwo) {
  for (const char* folder : {"a", "b"}) std::filesystem::create_directory(File(folder));
  Pack(Bag("a/run.db3", 0, 4));
  Pack(Bag("b/run.db3", 4, 2));
  WriteText("metadata.yaml",
            "rosbag2_bagfile_information:\n"
            "  relative_file_paths: [a/run.db3.zstd, b/run.db3.zstd]\n"
            "  compression_mode: FILE\n  compression_format: zstd\n");
  const auto reader = OpenRecording(File("."));
  EXPECT_EQ(reader->contents().messages, 6U);
  EXPECT_THAT(Told(*reader),
              ElementsAre("100 /a message 0", "101 /b message 1", "102 /a message 2",
                          "103 /b message 3", "104 /a message 4", "105 /b message 5"));
}

TEST_F(BagTest, TellsWhatIsWrongWithAFolder) {
  EXPECT_THAT(Reading(File(".")), HasSubstr("without metadata.yaml, so no ROS 2 bag"));
  const auto with = [this](const std::string& text) {
    WriteText("metadata.yaml", text);
    return Reading(File("."));
  };
  EXPECT_THAT(with("a: [\n"), HasSubstr("metadata.yaml"));
  EXPECT_THAT(with("a: 1\n"), HasSubstr("expected rosbag2_bagfile_information"));
  const std::string about = "rosbag2_bagfile_information:\n  relative_file_paths: ";
  EXPECT_THAT(with(about + "[]\n"), HasSubstr("expected rosbag2_bagfile_information"));
  EXPECT_THAT(with(about + "[missing.db3]\n"), HasSubstr("missing.db3: No such file"));
  Bag("twice.db3");
  EXPECT_THAT(with(about + "[twice.db3, a/twice.db3]\n"), HasSubstr("in the list already"));
  for (const char* outside : {"\"../run.db3\"", "/etc/passwd", ".", "{a: 1}"}) {
    EXPECT_THAT(with(about + "[" + outside + "]\n"), HasSubstr("metadata.yaml:2")) << outside;
  }
  EXPECT_THAT(with(about + "[run.db3.lz4]\n  compression_mode: FILE\n  compression_format: lz4\n"),
              AllOf(HasSubstr("is compressed by lz4"), HasSubstr("ros2 bag convert")));
}

TEST_F(BagTest, TellsWhatIsWrongWithAFile) {
  EXPECT_THAT(Reading(File("missing.db3")), HasSubstr("No such file"));
  WriteText("text.db3", "words");
  EXPECT_THAT(Reading(File("text.db3")), HasSubstr("its first bytes are not SQLite's"));
  Run(File("other.db3"), "CREATE TABLE a(b)");
  EXPECT_THAT(Reading(File("other.db3")), HasSubstr("no table 'topics'"));
  const auto with = [this](const std::string& name, const std::string& statements) {
    Run(Bag(name), statements);
    return Reading(File(name));
  };
  EXPECT_THAT(with("1.db3", "INSERT INTO messages VALUES(99, 5, 100, x'00')"),
              HasSubstr("a topic that the file does not describe"));
  EXPECT_THAT(with("2.db3", "INSERT INTO messages VALUES(99, 7, -1, x'00')"),
              HasSubstr("before 1970"));
  EXPECT_THAT(with("3.db3", "INSERT INTO messages VALUES(99, 7, 'noon', x'00')"),
              HasSubstr("time of a message: expected a whole number"));
  EXPECT_THAT(with("4.db3", "INSERT INTO messages VALUES(99, 7, 100, 'text')"),
              HasSubstr("data of a message: expected bytes"));
  EXPECT_THAT(with("5.db3", "UPDATE topics SET type = x'00'"),
              HasSubstr("type of a topic: expected a text"));
}

TEST_F(BagTest, RunsNothingThatAFileDefines) {
  // A view that never ends in place of the table.
  Run(Bag(),
      "ALTER TABLE messages RENAME TO kept;"
      "CREATE VIEW messages AS WITH RECURSIVE n(id) AS (SELECT 1 UNION ALL SELECT id + 1 FROM n) "
      "SELECT id, 7 AS topic_id, id AS timestamp, x'00' AS data FROM n;");
  EXPECT_THAT(Reading(File("run.db3")), HasSubstr("no table 'messages'"));
  Run(File("virtual.db3"),
      "CREATE VIRTUAL TABLE messages USING fts5(id, topic_id, timestamp, data);"
      "CREATE TABLE topics(id, name, type, serialization_format)");
  EXPECT_THAT(Reading(File("virtual.db3")), HasSubstr("'messages' is no plain table"));
  Run(File("computed.db3"),
      "CREATE TABLE topics(id, name, type, serialization_format);"
      "CREATE TABLE messages(id, topic_id, timestamp, data GENERATED ALWAYS AS (zeroblob(9)))");
  EXPECT_THAT(Reading(File("computed.db3")), HasSubstr("'messages' has columns that are computed"));
}

TEST_F(BagTest, WritesNothingBesideABagInWalMode) {
  Run(Bag("wal #1?.db3"), "PRAGMA journal_mode = WAL; UPDATE topics SET name = name");
  const auto reader = OpenRecording(File("wal #1?.db3"));
  EXPECT_EQ(Told(*reader).size(), 4U);
  EXPECT_FALSE(std::filesystem::exists(File("wal #1?.db3-wal")));
  EXPECT_FALSE(std::filesystem::exists(File("wal #1?.db3-shm")));
}

TEST_F(BagTest, ReadsWhatAKilledWriterLeftInTheWal) {
  sqlite3* writer = nullptr;
  ASSERT_EQ(sqlite3_open(Bag().c_str(), &writer), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(writer,
                         "PRAGMA journal_mode = WAL;"
                         "INSERT INTO messages VALUES(99, 7, 200, x'00')",
                         nullptr, nullptr, nullptr),
            SQLITE_OK);
  EXPECT_EQ(OpenRecording(File("run.db3"))->contents().messages, 5U);
  sqlite3_close(writer);
}

TEST_F(BagTest, SaysThatAJournalIsLeft) {
  sqlite3* writer = nullptr;
  Run(Bag(),
      "WITH RECURSIVE n(i) AS (SELECT 100 UNION ALL SELECT i + 1 FROM n WHERE i < 2000) "
      "INSERT INTO messages SELECT i, 7, i, x'00' FROM n");
  ASSERT_EQ(sqlite3_open(File("run.db3").c_str(), &writer), SQLITE_OK);
  EXPECT_EQ(
      sqlite3_exec(writer, "PRAGMA cache_size = 1; BEGIN; UPDATE messages SET data = zeroblob(200)",
                   nullptr, nullptr, nullptr),
      SQLITE_OK);
  for (const char* end : {"", "-journal"}) {
    std::filesystem::copy_file(File("run.db3" + std::string(end)),
                               File("torn.db3" + std::string(end)));
  }
  sqlite3_close(writer);
  EXPECT_THAT(Reading(File("torn.db3")), AllOf(HasSubstr("-journal"), HasSubstr("copy")));
}

TEST_F(BagTest, ReadsManyTopicsOfAFolderInNoTime) {
  std::string text = kTables;
  text +=
      "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < 20000) "
      "INSERT INTO topics SELECT i, '/topic' || i, 'a_msgs/msg/A', 'cdr', '' FROM n";
  Run(File("run.db3"), text);
  WriteText("metadata.yaml", "rosbag2_bagfile_information: {relative_file_paths: [run.db3]}\n");
  const auto begun = std::chrono::steady_clock::now();
  EXPECT_EQ(OpenRecording(File("."))->contents().channels.size(), 20000U);
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(5));
}

TEST_F(BagTest, RefusesAFileThatUnpacksToFarMoreThanItHas) {
  const std::string zeros(std::size_t{100} << 20, '\0');
  std::string packed(ZSTD_compressBound(zeros.size()), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), zeros.data(), zeros.size(), 1));
  WriteText("bomb.db3.zstd", packed + packed + packed);
  EXPECT_THAT(Reading(File("bomb.db3.zstd")), HasSubstr("it has more than"));
}

TEST_F(BagTest, ADamagedFileIsReadOrToldOf) {
  const std::string whole = FileText(Bag("whole.db3", 0, 400));
  ASSERT_EQ(Reading(File("whole.db3")), "");
  int told = 0;
  const auto damage = [&](const std::string& text) {
    WriteText("damaged.db3", text);
    const std::string why = Reading(File("damaged.db3"));
    if (why.empty()) return;
    EXPECT_THAT(why, HasSubstr("damaged.db3: "));
    ++told;
  };
  for (std::size_t size = 0; size < whole.size(); size += 997) damage(whole.substr(0, size));
  for (std::size_t at = 0; at < whole.size(); at += at < 4096 ? 13 : 499) {
    std::string text = whole;
    text[at] = static_cast<char>(~text[at]);
    damage(text);
  }
  EXPECT_GT(told, 20);
}

}  // namespace
}  // namespace understudy::record
