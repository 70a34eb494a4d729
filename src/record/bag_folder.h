// Reads the folder of a ROS 2 bag.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "base/temporary_folder.h"
#include "record/recording_reader.h"

namespace understudy::record {

// The files that its metadata.yaml names, .db3 or .mcap, one after the other; zstd may have
// compressed each of them, or each message. What is no such folder, or lacks a file, throws
// RecordError.
class BagFolder final : public RecordingReader {
 public:
  explicit BagFolder(const std::filesystem::path& path);

  using RecordingReader::ReadMessages;
  void ReadMessages(std::uint64_t from, std::uint64_t to, const Visit& visit) const override;

 private:
  struct Part {
    std::unique_ptr<RecordingReader> reader;
    std::map<std::uint16_t, std::uint16_t> channels;  // of the folder, by those of the file
  };

  void Add(std::unique_ptr<RecordingReader> reader);
  // What one topic has in all files: topic, encoding, type ("" without one), metadata.
  using Alike = std::tuple<std::string, std::string, std::string, StringMap>;

  std::uint16_t ChannelLike(const RecordingReader& reader, const McapChannel& channel);

  std::shared_ptr<const TemporaryFolder> room_;  // of unpacked files; null: there are none
  std::vector<Part> parts_;
  std::map<Alike, std::uint16_t> known_;  // channels of the folder
};

}  // namespace understudy::record
