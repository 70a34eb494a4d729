#include "record/bag_file.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <utility>

#include <sqlite3.h>

#include "base/errors.h"
#include "base/printed.h"
#include "record/packed.h"

namespace understudy::record {
namespace {

// The largest text or message, bytes; *assumed*, many times that of any robot's.
constexpr int kMostValue = 1 << 28;

// What a writer that was killed leaves beside a bag.
constexpr std::array<const char*, 2> kPending{"-wal", "-journal"};

bool IsPending(const std::filesystem::path& bag) {
  return std::ranges::any_of(kPending, [&](const char* end) {
    std::error_code error;
    const auto size = std::filesystem::file_size(bag.string() + end, error);
    return !error && size > 0;
  });
}

// Nothing is written beside a bag of which nothing is pending, in WAL mode either.
std::string UriOf(const std::filesystem::path& bag) {
  std::string uri = "file://";
  for (const char c : std::filesystem::absolute(bag).string()) {
    if (c == '%' || c == '?' || c == '#') {
      uri += Printed("%%%02X", c);
    } else {
      uri += c;
    }
  }
  return IsPending(bag) ? uri : uri + "?immutable=1";
}

}  // namespace

// One statement and its rows.
class BagFile::Query {
 public:
  Query(const BagFile& file, const char* text) : file_(file) {
    sqlite3_stmt* statement = nullptr;
    const int code = sqlite3_prepare_v2(file.database_.get(), text, -1, &statement, nullptr);
    statement_.reset(statement);
    if (code != SQLITE_OK) file_.FailBySqlite();
  }

  void Bind(int place, std::int64_t value) { sqlite3_bind_int64(statement_.get(), place, value); }
  void Bind(int place, const char* text) {
    sqlite3_bind_text(statement_.get(), place, text, -1, SQLITE_STATIC);
  }
  // Returns false after the last row.
  bool Next() {
    const int code = sqlite3_step(statement_.get());
    if (code == SQLITE_ROW) return true;
    if (code != SQLITE_DONE) file_.FailBySqlite();
    return false;
  }
  std::int64_t Integer(int column, const char* what) const {
    Require(column, SQLITE_INTEGER, what, "a whole number");
    return sqlite3_column_int64(statement_.get(), column);
  }
  std::string Text(int column, const char* what) const {
    Require(column, SQLITE_TEXT, what, "a text");
    const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
    const int size = sqlite3_column_bytes(statement_.get(), column);
    return text == nullptr ? std::string() : std::string(text, static_cast<std::size_t>(size));
  }
  // Valid until the next row.
  ByteSpan Bytes(int column, const char* what) const {
    Require(column, SQLITE_BLOB, what, "bytes");
    const auto* bytes =
        static_cast<const std::byte*>(sqlite3_column_blob(statement_.get(), column));
    const int size = sqlite3_column_bytes(statement_.get(), column);
    return bytes == nullptr ? ByteSpan() : ByteSpan(bytes, static_cast<std::size_t>(size));
  }

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };

  // SQLite keeps any type in any column.
  void Require(int column, int type, const char* what, const char* expected) const {
    if (sqlite3_column_type(statement_.get(), column) != type) {
      file_.Fail(std::string(what) + ": expected " + expected);
    }
  }

  const BagFile& file_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

void BagFile::Close::operator()(sqlite3* database) const { sqlite3_close_v2(database); }

BagFile::BagFile(const std::filesystem::path& path) : RecordingReader(path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    throw RecordError(path.string() + ": No such file or directory");
  }
  if (!std::filesystem::is_regular_file(path, error)) {
    throw RecordError(path.string() + ": is not a file");
  }
  std::array<char, kSqliteMagic.size()> first{};
  std::ifstream file(path, std::ios::binary);
  if (!file) throw RecordError(path.string() + ": cannot be read");
  file.read(first.data(), static_cast<std::streamsize>(first.size()));
  if (!std::ranges::equal(first, kSqliteMagic)) {
    throw RecordError(path.string() + ": is not a ROS 2 bag: its first bytes are not SQLite's");
  }
  sqlite3* database = nullptr;
  const int code = sqlite3_open_v2(UriOf(path).c_str(), &database,
                                   SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
  database_.reset(database);
  if (code != SQLITE_OK) Fail(sqlite3_errstr(code));
  // As SQLite advises for files of strangers: what they define is not run.
  for (const auto& [option, on] :
       {std::pair(SQLITE_DBCONFIG_DEFENSIVE, 1), std::pair(SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0),
        std::pair(SQLITE_DBCONFIG_ENABLE_VIEW, 0), std::pair(SQLITE_DBCONFIG_ENABLE_TRIGGER, 0)}) {
    sqlite3_db_config(database, option, on, nullptr);
  }
  sqlite3_limit(database, SQLITE_LIMIT_LENGTH, kMostValue);
  sqlite3_exec(database, "PRAGMA cell_size_check = ON; PRAGMA mmap_size = 0", nullptr, nullptr,
               nullptr);
  contents_.profile = "ros2";
  contents_.library = "ROS 2 bag, SQLite";
  RequireTable("topics");
  RequireTable("messages");
  ReadTopics();
  Count();
}

void BagFile::RequireTable(const char* name) const {
  Query query(*this, "SELECT sql FROM sqlite_schema WHERE type = 'table' AND name = ?1");
  query.Bind(1, name);
  if (!query.Next()) Fail("is not a ROS 2 bag: it has no table '" + std::string(name) + "'");
  if (!query.Text(0, "schema").starts_with("CREATE TABLE")) {
    Fail("is not a ROS 2 bag: '" + std::string(name) + "' is no plain table");
  }
  // A generated column would be an expression of the file's that reading runs.
  Query hidden(*this, "SELECT name FROM pragma_table_xinfo(?1) WHERE hidden != 0");
  hidden.Bind(1, name);
  if (hidden.Next()) {
    Fail("is not a ROS 2 bag: '" + std::string(name) + "' has columns that are computed");
  }
}

void BagFile::ReadTopics() {
  Query query(*this, "SELECT id, name, type, serialization_format FROM topics ORDER BY id");
  std::map<std::string, std::uint16_t> schemas;
  while (query.Next()) {
    if (channels_.size() >= std::numeric_limits<std::uint16_t>::max()) Fail("has too many topics");
    const auto id = static_cast<std::uint16_t>(channels_.size() + 1);
    channels_[query.Integer(0, "id of a topic")] = id;
    const std::string type = query.Text(2, "type of a topic");
    const auto [schema, is_new] =
        schemas.try_emplace(type, static_cast<std::uint16_t>(schemas.size() + 1));
    if (is_new) {
      contents_.schemas[schema->second] = {
          .id = schema->second, .name = type, .encoding = {}, .data = {}};
    }
    contents_.channels[id] = {.id = id,
                              .schema_id = schema->second,
                              .topic = query.Text(1, "name of a topic"),
                              .encoding = query.Text(3, "serialization_format of a topic"),
                              .metadata = {}};
  }
}

void BagFile::Count() {
  Query query(*this,
              "SELECT topic_id, count(*), min(timestamp), max(timestamp) FROM messages "
              "GROUP BY topic_id");
  while (query.Next()) {
    const auto channel = channels_.find(query.Integer(0, "topic of a message"));
    if (channel == channels_.end()) Fail("a message of a topic that the file does not describe");
    const auto count = static_cast<std::uint64_t>(query.Integer(1, "number of messages"));
    const std::int64_t first = query.Integer(2, "time of a message");
    const std::int64_t last = query.Integer(3, "time of a message");
    if (first < 0) Fail("a message from before 1970");
    const auto from = static_cast<std::uint64_t>(first), to = static_cast<std::uint64_t>(last);
    const bool none = contents_.messages == 0;
    contents_.first_time = none ? from : std::min(contents_.first_time, from);
    contents_.last_time = none ? to : std::max(contents_.last_time, to);
    contents_.messages += count;
    contents_.counts[channel->second] = count;
  }
}

void BagFile::ReadMessages(std::uint64_t from, std::uint64_t to, const Visit& visit) const {
  constexpr auto kLatest = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  Query query(*this,
              "SELECT topic_id, timestamp, data FROM messages WHERE timestamp BETWEEN ?1 AND ?2 "
              "ORDER BY timestamp, id");
  query.Bind(1, static_cast<std::int64_t>(std::min(from, kLatest)));
  query.Bind(2, static_cast<std::int64_t>(std::min(to, kLatest)));
  std::vector<std::byte> room;
  while (query.Next()) {
    const auto id = channels_.find(query.Integer(0, "topic of a message"));
    if (id == channels_.end()) Fail("a message of a topic that the file does not describe");
    const auto time = static_cast<std::uint64_t>(query.Integer(1, "time of a message"));
    const McapMessage message{.channel_id = id->second,
                              .log_time = time,
                              .publish_time = time,
                              .data = Unpacked(query.Bytes(2, "data of a message"), path(), &room)};
    if (!visit(contents_.channels.at(id->second), message)) return;
  }
}

void BagFile::FailBySqlite() const {
  const int code = sqlite3_errcode(database_.get());
  if ((code == SQLITE_READONLY || code == SQLITE_CANTOPEN) && IsPending(path())) {
    Fail(
        "its writer was killed, and what is left in -wal or -journal beside it has to be taken in: "
        "copy all of them to a folder of yours and run `sqlite3 COPY .schema` there");
  }
  Fail(sqlite3_errmsg(database_.get()));
}

void BagFile::Fail(const std::string& what) const {
  throw RecordError(path().string() + ": " + what);
}

}  // namespace understudy::record
