// Writes MCAP files with compressed chunks, indexes and checksums.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "record/mcap_format.h"
#include "record/output_file.h"

struct ZSTD_CCtx_s;

namespace understudy::record {

struct McapWriterOptions {
  std::size_t chunk_bytes = 4 << 20;  // of messages before compression; *assumed*
  int zstd_level = 1;                 // the fastest with a useful ratio; *assumed*
};

// Collects messages in a chunk and writes chunk and index in one piece, so the file is readable at
// any time, even if this process is killed. All functions throw RecordError if the file cannot be
// written; after that only the destructor may be called.
class McapWriter {
 public:
  // Writes the beginning of the file. `profile` is "ros2" for files that ROS 2 tools read as bags,
  // else "".
  McapWriter(OutputFile file, std::string_view profile, std::string_view library,
             const McapWriterOptions& options = {});
  ~McapWriter();
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  // Each returns the new id, counting from 1. Throws RecordError after 65535 of a kind.
  std::uint16_t AddSchema(std::string_view name, std::string_view encoding, std::string_view data);
  std::uint16_t AddChannel(std::string_view topic, std::uint16_t schema_id,
                           std::string_view encoding, const StringMap& metadata);

  // Adds a message; its sequence number counts the messages of the channel from 0. Times are ns
  // since 1970 and need not ascend.
  void Write(std::uint16_t channel_id, std::uint64_t log_time, std::uint64_t publish_time,
             ByteSpan data);
  void Attach(std::string_view name, std::string_view media_type, std::uint64_t log_time,
              ByteSpan data);
  void AddMetadata(std::string_view name, const StringMap& metadata);

  // Writes the current chunk to the file.
  void Flush();
  // Flushes and writes the summary. After that only const functions may be called.
  void Finish();

  std::uint64_t messages() const { return messages_; }
  std::uint64_t bytes() const { return file_.size(); }  // written to the file

 private:
  struct Channel {
    BytesOut record;
    std::uint64_t messages = 0;
    BytesOut index;  // log time and offset of each message in the chunk
  };
  struct Span {  // of time
    std::uint64_t first = 0, last = 0;
    bool empty = true;

    void Add(std::uint64_t time);
  };

  void Send(ByteSpan bytes);
  std::size_t Compress();  // chunk_ into compressed_; returns the size

  OutputFile file_;
  McapWriterOptions options_;
  std::unique_ptr<ZSTD_CCtx_s, std::size_t (*)(ZSTD_CCtx_s*)> zstd_;
  std::uint32_t data_crc_ = 0;
  std::vector<BytesOut> schemas_;
  std::vector<Channel> channels_;
  std::uint64_t messages_ = 0;
  Span all_;
  std::uint32_t attachments_ = 0, metadata_ = 0, chunks_ = 0;
  BytesOut attachment_indexes_, metadata_indexes_, chunk_indexes_;  // records of the summary

  BytesOut chunk_;  // records
  Span chunk_span_;
  std::vector<std::uint16_t> chunk_channels_;  // channels with messages in chunk_
  std::vector<std::byte> compressed_;
  BytesOut out_;  // a chunk and its indexes, to be written at once
};

}  // namespace understudy::record
