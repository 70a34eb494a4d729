#include "record/mcap_writer.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <zlib.h>
#include <zstd.h>

namespace understudy::record {
namespace {

constexpr std::size_t kMostIds = std::numeric_limits<std::uint16_t>::max();

void PutHead(McapOp op, std::uint64_t size, BytesOut* out) {
  out->Put(static_cast<std::uint8_t>(op));
  out->Put(size);
}

void PutRecord(McapOp op, const BytesOut& content, BytesOut* out) {
  PutHead(op, content.size(), out);
  out->PutRaw(content.span());
}

}  // namespace

std::uint32_t Crc32(ByteSpan bytes, std::uint32_t crc) {
  return static_cast<std::uint32_t>(
      crc32_z(crc, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

void McapWriter::Span::Add(std::uint64_t time) {
  first = empty ? time : std::min(first, time);
  last = empty ? time : std::max(last, time);
  empty = false;
}

McapWriter::McapWriter(OutputFile file, std::string_view profile, std::string_view library,
                       const McapWriterOptions& options)
    : file_(std::move(file)), options_(options), zstd_(ZSTD_createCCtx(), &ZSTD_freeCCtx) {
  ZSTD_CCtx_setParameter(zstd_.get(), ZSTD_c_compressionLevel, options.zstd_level);
  BytesOut header, out;
  header.PutString(profile);
  header.PutString(library);
  out.PutRaw(std::as_bytes(std::span(kMcapMagic)));
  PutRecord(McapOp::kHeader, header, &out);
  Send(out.span());
}

McapWriter::~McapWriter() = default;

std::uint16_t McapWriter::AddSchema(std::string_view name, std::string_view encoding,
                                    std::string_view data) {
  if (schemas_.size() == kMostIds) throw RecordError("a recording cannot have more schemas");
  const auto id = static_cast<std::uint16_t>(schemas_.size() + 1);
  BytesOut schema;
  schema.Put(id);
  schema.PutString(name);
  schema.PutString(encoding);
  schema.PutString(data);
  PutRecord(McapOp::kSchema, schema, &schemas_.emplace_back());
  chunk_.PutRaw(schemas_.back().span());
  return id;
}

std::uint16_t McapWriter::AddChannel(std::string_view topic, std::uint16_t schema_id,
                                     std::string_view encoding, const StringMap& metadata) {
  if (channels_.size() == kMostIds) {
    throw RecordError("a recording cannot have more channels");
  }
  const auto id = static_cast<std::uint16_t>(channels_.size() + 1);
  BytesOut channel;
  channel.Put(id);
  channel.Put(schema_id);
  channel.PutString(topic);
  channel.PutString(encoding);
  channel.PutMap(metadata);
  PutRecord(McapOp::kChannel, channel, &channels_.emplace_back().record);
  chunk_.PutRaw(channels_.back().record.span());
  return id;
}

void McapWriter::Write(std::uint16_t channel_id, std::uint64_t log_time, std::uint64_t publish_time,
                       ByteSpan data) {
  Channel& channel = channels_[channel_id - 1U];
  if (channel.index.empty()) chunk_channels_.push_back(channel_id);
  channel.index.Put(log_time);
  channel.index.Put(static_cast<std::uint64_t>(chunk_.size()));
  PutHead(McapOp::kMessage, kMcapMessageHead + data.size(), &chunk_);
  chunk_.Put(channel_id);
  chunk_.Put(static_cast<std::uint32_t>(channel.messages));
  chunk_.Put(log_time);
  chunk_.Put(publish_time);
  chunk_.PutRaw(data);
  chunk_span_.Add(log_time);
  all_.Add(log_time);
  ++channel.messages;
  ++messages_;
  if (chunk_.size() >= options_.chunk_bytes) Flush();
}

void McapWriter::Attach(std::string_view name, std::string_view media_type, std::uint64_t log_time,
                        ByteSpan data) {
  Flush();
  BytesOut attachment;
  attachment.Put(log_time);
  attachment.Put(log_time);  // also as the time of creation
  attachment.PutString(name);
  attachment.PutString(media_type);
  attachment.Put(static_cast<std::uint64_t>(data.size()));
  attachment.PutRaw(data);
  attachment.Put(Crc32(attachment.span()));
  BytesOut out;
  PutRecord(McapOp::kAttachment, attachment, &out);

  BytesOut index;
  index.Put(file_.size());
  index.Put(static_cast<std::uint64_t>(out.size()));
  index.Put(log_time);
  index.Put(log_time);
  index.Put(static_cast<std::uint64_t>(data.size()));
  index.PutString(name);
  index.PutString(media_type);
  Send(out.span());
  PutRecord(McapOp::kAttachmentIndex, index, &attachment_indexes_);
  ++attachments_;
}

void McapWriter::AddMetadata(std::string_view name, const StringMap& metadata) {
  Flush();
  BytesOut content, out, index;
  content.PutString(name);
  content.PutMap(metadata);
  PutRecord(McapOp::kMetadata, content, &out);
  index.Put(file_.size());
  index.Put(static_cast<std::uint64_t>(out.size()));
  index.PutString(name);
  Send(out.span());
  PutRecord(McapOp::kMetadataIndex, index, &metadata_indexes_);
  ++metadata_;
}

void McapWriter::Flush() {
  if (chunk_.empty()) return;
  const std::size_t compressed = Compress();
  constexpr std::string_view kCompression = "zstd";

  // The chunk.
  out_.clear();
  PutHead(McapOp::kChunk, 8 + 8 + 8 + 4 + 4 + kCompression.size() + 8 + compressed, &out_);
  out_.Put(chunk_span_.first);
  out_.Put(chunk_span_.last);
  out_.Put(static_cast<std::uint64_t>(chunk_.size()));
  out_.Put(Crc32(chunk_.span()));
  out_.PutString(kCompression);
  out_.Put(static_cast<std::uint64_t>(compressed));
  out_.PutRaw(ByteSpan(compressed_).first(compressed));
  const std::size_t chunk_length = out_.size();

  // Its message indexes.
  BytesOut offsets;
  for (const std::uint16_t id : chunk_channels_) {
    offsets.Put(id);
    offsets.Put(static_cast<std::uint64_t>(file_.size() + out_.size()));
    BytesOut& entries = channels_[id - 1U].index;
    PutHead(McapOp::kMessageIndex, 2 + 4 + entries.size(), &out_);
    out_.Put(id);
    out_.Put(static_cast<std::uint32_t>(entries.size()));
    out_.PutRaw(entries.span());
    entries.clear();
  }

  // Its entry in the summary.
  BytesOut index;
  index.Put(chunk_span_.first);
  index.Put(chunk_span_.last);
  index.Put(file_.size());
  index.Put(static_cast<std::uint64_t>(chunk_length));
  index.Put(static_cast<std::uint32_t>(offsets.size()));
  index.PutRaw(offsets.span());
  index.Put(static_cast<std::uint64_t>(out_.size() - chunk_length));
  index.PutString(kCompression);
  index.Put(static_cast<std::uint64_t>(compressed));
  index.Put(static_cast<std::uint64_t>(chunk_.size()));
  Send(out_.span());
  PutRecord(McapOp::kChunkIndex, index, &chunk_indexes_);
  ++chunks_;
  chunk_.clear();
  chunk_channels_.clear();
  chunk_span_ = {};
}

void McapWriter::Finish() {
  Flush();
  BytesOut out;
  BytesOut data_end;
  data_end.Put(data_crc_);
  PutRecord(McapOp::kDataEnd, data_end, &out);

  // Records of the summary.
  BytesOut schemas, channels, counts;
  for (const BytesOut& schema : schemas_) schemas.PutRaw(schema.span());
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    channels.PutRaw(channels_[i].record.span());
    counts.Put(static_cast<std::uint16_t>(i + 1));
    counts.Put(channels_[i].messages);
  }
  BytesOut statistics, statistics_record;
  statistics.Put(messages_);
  statistics.Put(static_cast<std::uint16_t>(schemas_.size()));
  statistics.Put(static_cast<std::uint32_t>(channels_.size()));
  statistics.Put(attachments_);
  statistics.Put(metadata_);
  statistics.Put(chunks_);
  statistics.Put(all_.first);
  statistics.Put(all_.last);
  statistics.Put(static_cast<std::uint32_t>(counts.size()));
  statistics.PutRaw(counts.span());
  PutRecord(McapOp::kStatistics, statistics, &statistics_record);

  // The summary, by groups with their offsets.
  const std::size_t summary_begin = out.size();
  const std::uint64_t summary_start = file_.size() + summary_begin;
  BytesOut offsets;
  const auto group = [&](McapOp op, const BytesOut& records) {
    if (records.empty()) return;
    BytesOut offset;
    offset.Put(static_cast<std::uint8_t>(op));
    offset.Put(static_cast<std::uint64_t>(file_.size() + out.size()));
    offset.Put(static_cast<std::uint64_t>(records.size()));
    PutRecord(McapOp::kSummaryOffset, offset, &offsets);
    out.PutRaw(records.span());
  };
  group(McapOp::kSchema, schemas);
  group(McapOp::kChannel, channels);
  group(McapOp::kStatistics, statistics_record);
  group(McapOp::kChunkIndex, chunk_indexes_);
  group(McapOp::kAttachmentIndex, attachment_indexes_);
  group(McapOp::kMetadataIndex, metadata_indexes_);
  const std::uint64_t offsets_start = file_.size() + out.size();
  out.PutRaw(offsets.span());

  // Footer.
  PutHead(McapOp::kFooter, kMcapFooter, &out);
  out.Put(summary_start);
  out.Put(offsets_start);
  out.Put(Crc32(out.span().subspan(summary_begin)));
  out.PutRaw(std::as_bytes(std::span(kMcapMagic)));
  file_.Write(out.span());
}

void McapWriter::Send(ByteSpan bytes) {
  file_.Write(bytes);
  data_crc_ = Crc32(bytes, data_crc_);
}

std::size_t McapWriter::Compress() {
  compressed_.resize(ZSTD_compressBound(chunk_.size()));
  const std::size_t size = ZSTD_compress2(zstd_.get(), compressed_.data(), compressed_.size(),
                                          chunk_.span().data(), chunk_.size());
  if (ZSTD_isError(size) != 0) {
    throw RecordError(std::string("cannot be compressed: ") + ZSTD_getErrorName(size));
  }
  return size;
}

}  // namespace understudy::record
