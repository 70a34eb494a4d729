#include "record/bag_folder.h"

#include <algorithm>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include "base/errors.h"
#include "record/bag_file.h"
#include "record/mcap_reader.h"
#include "record/packed.h"
#include "schema/yaml_document.h"

namespace understudy::record {
namespace {

namespace fs = std::filesystem;
using Kind = schema::YamlValue::Kind;

schema::YamlValue ReadMetadata(const fs::path& folder) {
  const fs::path file = folder / "metadata.yaml";
  std::error_code error;
  if (!fs::exists(file, error)) {
    throw RecordError(folder.string() +
                      ": is a folder without metadata.yaml, so no ROS 2 bag; `ros2 bag reindex` "
                      "makes one where a recording was cut short");
  }
  try {
    return schema::ReadYamlFile(file);
  } catch (const ConfigError& wrong) {
    throw RecordError(wrong.what());
  }
}

// Where a file of the bag is: older bags name it from the folder above.
fs::path PlaceOf(const fs::path& folder, const schema::YamlValue& name) {
  const fs::path written = name.text;
  if (name.kind != Kind::kScalar || written.empty() || written.is_absolute() ||
      std::ranges::find(written, "..") != written.end()) {
    throw RecordError(name.where + ": relative_file_paths: expected a file in this folder, got " +
                      schema::Shown(name));
  }
  std::error_code error;
  return fs::exists(folder / written, error) ? folder / written : folder / written.filename();
}

}  // namespace

BagFolder::BagFolder(const fs::path& path) : RecordingReader(path) {
  const schema::YamlValue metadata = ReadMetadata(path);
  const schema::YamlValue* const about = metadata.Find("rosbag2_bagfile_information");
  const schema::YamlValue* const files =
      about == nullptr ? nullptr : about->Find("relative_file_paths");
  if (files == nullptr || files->kind != Kind::kSequence || files->items.empty()) {
    throw RecordError((path / "metadata.yaml").string() +
                      ": expected rosbag2_bagfile_information with relative_file_paths, the list "
                      "of the bag's files");
  }
  const schema::YamlValue* const format = about->Find("compression_format");
  if (format != nullptr && format->kind == Kind::kScalar && !format->text.empty() &&
      format->text != "zstd") {
    throw RecordError(format->where + ": the bag is compressed by " +
                      schema::OneLine(format->text) +
                      ", expected zstd; `ros2 bag convert` writes one that is not compressed");
  }
  contents_.profile = "ros2";
  contents_.library = "ROS 2 bag";
  std::set<fs::path> files_so_far;
  for (const schema::YamlValue& name : files->items) {
    const fs::path file = PlaceOf(path, name);
    std::error_code error;
    if (!files_so_far.insert(fs::weakly_canonical(file, error)).second) {
      throw RecordError(name.where +
                        ": a file that is in the list already: " + schema::Shown(name));
    }
    if (fs::is_directory(file, error)) {
      throw RecordError(name.where + ": expected a file, got a folder: " + schema::Shown(name));
    }
    if (IsPacked(file)) {
      if (room_ == nullptr) room_ = std::make_shared<const TemporaryFolder>("bag");
      Add(std::make_unique<PackedFile>(file, room_));
    } else {
      Add(OpenRecording(file));
    }
  }
  std::ranges::stable_sort(parts_, {},
                           [](const Part& part) { return part.reader->contents().first_time; });
}

void BagFolder::Add(std::unique_ptr<RecordingReader> reader) {
  const McapContents& more = reader->contents();
  Part part{.reader = std::move(reader), .channels = {}};
  for (const auto& [id, channel] : more.channels) {
    const std::uint16_t ours = ChannelLike(*part.reader, channel);
    part.channels[id] = ours;
    const auto count = more.counts.find(id);
    if (count != more.counts.end()) contents_.counts[ours] += count->second;
  }
  if (more.messages > 0) {
    const bool none = contents_.messages == 0;
    contents_.first_time = none ? more.first_time : std::min(contents_.first_time, more.first_time);
    contents_.last_time = none ? more.last_time : std::max(contents_.last_time, more.last_time);
    contents_.messages += more.messages;
  }
  contents_.metadata.insert(more.metadata.begin(), more.metadata.end());
  if (contents_.cut_short.empty()) contents_.cut_short = more.cut_short;
  parts_.push_back(std::move(part));
}

// Files of a bag have the same topics, each with ids of its own.
std::uint16_t BagFolder::ChannelLike(const RecordingReader& reader, const McapChannel& channel) {
  const McapSchema* const schema = reader.SchemaOf(channel);
  const auto [known, is_new] = known_.try_emplace(
      {channel.topic, channel.encoding, schema == nullptr ? "" : schema->name, channel.metadata});
  if (!is_new) return known->second;
  if (contents_.channels.size() >= std::numeric_limits<std::uint16_t>::max()) {
    throw RecordError(path().string() + ": has too many topics");
  }
  McapChannel ours = channel;
  ours.id = static_cast<std::uint16_t>(contents_.channels.size() + 1);
  ours.schema_id = schema == nullptr ? std::uint16_t{0} : ours.id;
  if (schema != nullptr) {
    contents_.schemas[ours.id] = *schema;
    contents_.schemas[ours.id].id = ours.id;
  }
  contents_.channels[ours.id] = ours;
  known->second = ours.id;
  return ours.id;
}

void BagFolder::ReadMessages(std::uint64_t from, std::uint64_t to, const Visit& visit) const {
  bool more = true;
  std::vector<std::byte> room;
  for (const Part& part : parts_) {
    if (!more) return;
    part.reader->ReadMessages(from, to, [&](const McapChannel& channel, McapMessage message) {
      message.channel_id = part.channels.at(channel.id);
      message.data = Unpacked(message.data, part.reader->path(), &room);
      more = visit(contents_.channels.at(message.channel_id), message);
      return more;
    });
    if (contents_.cut_short.empty()) contents_.cut_short = part.reader->contents().cut_short;
  }
}

}  // namespace understudy::record
