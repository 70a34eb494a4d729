// The interface through which recordings of every file format are read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "record/mcap_format.h"

namespace understudy::record {

struct McapAttachment {
  std::string name{};
  std::string media_type{};
  std::uint64_t log_time = 0;  // ns since 1970
  std::uint64_t offset = 0;    // of its record in the file
  std::uint64_t size = 0;      // of its data, bytes
};

// What a recording contains besides the data of its messages, in the terms of MCAP.
struct McapContents {
  std::string profile{};
  std::string library{};
  std::map<std::uint16_t, McapSchema> schemas{};
  std::map<std::uint16_t, McapChannel> channels{};
  std::map<std::uint16_t, std::uint64_t> counts{};  // messages by channel
  std::uint64_t messages = 0;
  std::uint64_t first_time = 0, last_time = 0;  // of log times; 0 without messages
  std::vector<McapAttachment> attachments{};
  std::map<std::string, StringMap> metadata{};
  // "" for a complete recording; else why it ends early or what of it is left out. Everything else
  // can be read. Of a finished file damage is found only when its messages are read.
  mutable std::string cut_short{};
};

class RecordingReader {
 public:
  explicit RecordingReader(std::filesystem::path path) : path_(std::move(path)) {}
  virtual ~RecordingReader() = default;
  RecordingReader(const RecordingReader&) = delete;
  RecordingReader& operator=(const RecordingReader&) = delete;

  const McapContents& contents() const { return contents_; }
  const std::filesystem::path& path() const { return path_; }

  // Returns the schema of a channel; nullptr if it has none.
  const McapSchema* SchemaOf(const McapChannel& channel) const;

  // Calls visit(channel, message) with each message whose log time is in [from, to] (ns since 1970)
  // until visit returns false, in about the order of time: that of the file. The message's data is
  // valid during the call. Leaves out what is damaged (cut_short). Throws RecordError.
  using Visit = std::function<bool(const McapChannel&, const McapMessage&)>;
  virtual void ReadMessages(std::uint64_t from, std::uint64_t to, const Visit& visit) const = 0;
  void ReadMessages(const Visit& visit) const { ReadMessages(0, ~std::uint64_t{0}, visit); }

 protected:
  McapContents contents_;  // NOLINT: the readers fill it in

 private:
  std::filesystem::path path_;
};

// Opens an MCAP file, a ROS 2 bag in SQLite (.db3), one of both that zstd compressed, or the folder
// of a ROS 2 bag, told apart by their content. Throws RecordError.
std::unique_ptr<RecordingReader> OpenRecording(const std::filesystem::path& path);

}  // namespace understudy::record
