#include "record/recording_reader.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>

#include "base/errors.h"
#include "record/bag_file.h"
#include "record/bag_folder.h"
#include "record/mcap_reader.h"
#include "record/packed.h"

namespace understudy::record {

const McapSchema* RecordingReader::SchemaOf(const McapChannel& channel) const {
  const auto found = contents_.schemas.find(channel.schema_id);
  return found == contents_.schemas.end() ? nullptr : &found->second;
}

std::unique_ptr<RecordingReader> OpenRecording(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return std::make_unique<BagFolder>(path);
  if (IsPacked(path)) {
    return std::make_unique<PackedFile>(path, std::make_shared<const TemporaryFolder>("bag"));
  }
  // Only of a file: reading a pipe would wait for its writer.
  if (std::filesystem::is_regular_file(path, error)) {
    std::array<char, kSqliteMagic.size()> first{};
    std::ifstream file(path, std::ios::binary);
    file.read(first.data(), static_cast<std::streamsize>(first.size()));
    if (std::ranges::equal(first, kSqliteMagic)) return std::make_unique<BagFile>(path);
  }
  if (path.extension() == ".db3") return std::make_unique<BagFile>(path);
  return std::make_unique<McapReader>(path);
}

}  // namespace understudy::record
