// Reads ROS 2 bags in SQLite, as rosbag2 writes them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "record/recording_reader.h"

struct sqlite3;

namespace understudy::record {

// The first bytes of every file.
inline constexpr std::string_view kSqliteMagic{"SQLite format 3\0", 16};

// One file of a bag: its tables `topics` and `messages`. Files may be damaged, or made to do harm:
// nothing in one is run. What is no such file, or is broken, throws RecordError with the file.
class BagFile final : public RecordingReader {
 public:
  explicit BagFile(const std::filesystem::path& path);

  using RecordingReader::ReadMessages;
  void ReadMessages(std::uint64_t from, std::uint64_t to, const Visit& visit) const override;

 private:
  class Query;
  struct Close {
    void operator()(sqlite3* database) const;
  };

  void RequireTable(const char* name) const;
  void ReadTopics();
  void Count();
  [[noreturn]] void FailBySqlite() const;
  [[noreturn]] void Fail(const std::string& what) const;

  std::unique_ptr<sqlite3, Close> database_;
  std::map<std::int64_t, std::uint16_t> channels_;  // by the id of a topic in the file
};

}  // namespace understudy::record
