#include "record/mcap_reader.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>

#include "record/mcap_format.h"
#include "record/packed.h"

namespace understudy::record {
namespace {

// The largest content of a record; *assumed*, many times that of common writers.
constexpr std::uint64_t kMostRecord = std::uint64_t{1} << 30;

constexpr std::uint64_t kTail = kMcapRecordHead + kMcapFooter + kMcapMagic.size();

}  // namespace

McapReader::McapReader(std::filesystem::path file) : RecordingReader(std::move(file)) {
  // O_NONBLOCK: opening a pipe must not wait for its writer.
  fd_ = UniqueFd(::open(path().c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status {};
  if (!fd_.valid() || ::fstat(fd_.get(), &status) != 0) {
    const std::string why = std::strerror(errno);  // NOLINT(concurrency-mt-unsafe)
    throw RecordError(path().string() + ": " + why);
  }
  if (!S_ISREG(status.st_mode)) throw RecordError(path().string() + ": is not a file");
  size_ = static_cast<std::uint64_t>(status.st_size);
  const auto has_magic = [&](std::uint64_t offset) {
    return std::ranges::equal(Read(offset, kMcapMagic.size()),
                              std::as_bytes(std::span(kMcapMagic)));
  };
  if (size_ < kMcapMagic.size() || !has_magic(0)) {
    throw RecordError(path().string() + ": is not an MCAP file: its first bytes are wrong");
  }
  if (size_ < kMcapMagic.size() + kMcapRecordHead) {
    throw RecordError(path().string() + ": ends before its header");
  }
  const Record header = ReadRecord(kMcapMagic.size());
  if (header.op != McapOp::kHeader) Fail(header.offset, "expected the header");
  Note(header, false);
  const bool finished = size_ >= kTail + kMcapMagic.size() && has_magic(size_ - kMcapMagic.size());
  if (finished && ReadSummary()) return;
  Scan(kMcapMagic.size() + kMcapRecordHead + header.content.size());
}

// Returns false if there is no summary or it does not list the chunks.
bool McapReader::ReadSummary() {
  const Record footer = ReadRecord(size_ - kTail);
  if (footer.op != McapOp::kFooter || footer.content.size() < kMcapFooter) {
    Fail(footer.offset, "expected the footer");
  }
  BytesIn in(footer.content);
  const auto start = in.Take<std::uint64_t>();
  in.Take<std::uint64_t>();
  const auto crc = in.Take<std::uint32_t>();
  if (start == 0) return false;
  if (start < kMcapMagic.size() || start > footer.offset) {
    Fail(footer.offset, "the footer has the summary begin at " + std::to_string(start));
  }
  if (footer.offset - start > kMostRecord) Fail(start, "the summary is too long");
  const std::uint64_t checked = footer.offset + kMcapRecordHead + 8 + 8 - start;
  if (crc != 0 && Crc32(Read(start, checked)) != crc) {
    Fail(start, "the summary's checksum is wrong");
  }
  bool counted = false;
  for (std::uint64_t at = start; at < footer.offset;) {
    const Record record = ReadRecord(at);
    Note(record, true);
    counted |= record.op == McapOp::kStatistics;
    at += kMcapRecordHead + record.content.size();
  }
  if (contents_.last_time < contents_.first_time)
    Fail(start, "its last message is before its first");
  if (counted && Describes()) {
    RequireApart();
    std::ranges::stable_sort(chunks_, {}, &Chunk::first_time);
    return true;
  }
  contents_ = {.profile = contents_.profile, .library = contents_.library};
  chunks_.clear();
  return false;
}

// Whether the summary describes all channels and chunks, which a writer may omit.
bool McapReader::Describes() const {
  if (contents_.messages > 0 && chunks_.empty()) return false;
  return std::ranges::all_of(contents_.counts, [this](const auto& count) {
    const auto channel = contents_.channels.find(count.first);
    return channel != contents_.channels.end() &&
           (channel->second.schema_id == 0 || SchemaOf(channel->second) != nullptr);
  });
}

// A file of some kB could else have one chunk read thousands of times.
void McapReader::RequireApart() const {
  std::vector<Chunk> chunks = chunks_;
  std::ranges::sort(chunks, {}, &Chunk::offset);
  for (std::size_t i = 1; i < chunks.size(); ++i) {
    const Chunk& before = chunks[i - 1];
    if (chunks[i].offset - before.offset < std::max<std::uint64_t>(before.size, 1)) {
      Fail(chunks[i].offset, "the summary has chunks that overlap");
    }
  }
}

void McapReader::Scan(std::uint64_t begin) {
  std::string damage;
  bool over = false;
  for (std::uint64_t at = begin; at < size_ && !over;) {
    std::uint64_t size = 0;
    bool is_chunk = false;
    try {
      const Record record = ReadRecord(at);
      if (record.op == McapOp{}) Fail(at, "zeros, as a power cut leaves them");
      size = kMcapRecordHead + record.content.size();
      is_chunk = record.op == McapOp::kChunk;
      over = record.op == McapOp::kDataEnd || record.op == McapOp::kFooter;
      if (!over) Note(record, false);
    } catch (const RecordError& error) {
      // A killed writer leaves a truncated last record, a power cut zeros, also within chunks: what
      // is whole is read. Any other fault is an error.
      if (size != 0 && !is_chunk) throw;
      if (damage.empty()) damage = error.what();
      if (size == 0) break;
      damage += "; what it held is left out";
    }
    at += size;
  }
  contents_.cut_short = !damage.empty() || over ? damage : "its end is missing";
  std::ranges::stable_sort(chunks_, {}, &Chunk::first_time);
}

void McapReader::Note(const Record& record, bool in_summary) {
  BytesIn in(record.content);
  try {
    switch (record.op) {
      case McapOp::kHeader:
        contents_.profile = in.TakeString();
        contents_.library = in.TakeString();
        break;
      case McapOp::kSchema: {
        McapSchema schema = TakeSchema(&in);
        contents_.schemas[schema.id] = std::move(schema);
        break;
      }
      case McapOp::kChannel: {
        McapChannel channel = TakeChannel(&in);
        contents_.channels[channel.id] = std::move(channel);
        break;
      }
      case McapOp::kStatistics: {
        contents_.messages = in.Take<std::uint64_t>();
        in.TakeRaw(2 + 4 * 4);
        contents_.first_time = in.Take<std::uint64_t>();
        contents_.last_time = in.Take<std::uint64_t>();
        BytesIn counts(in.TakeRaw(in.Take<std::uint32_t>()));
        while (counts.remaining() > 0) {
          const auto id = counts.Take<std::uint16_t>();
          contents_.counts[id] = counts.Take<std::uint64_t>();
        }
        break;
      }
      case McapOp::kChunkIndex: {
        Chunk chunk;
        chunk.first_time = in.Take<std::uint64_t>();
        chunk.last_time = in.Take<std::uint64_t>();
        chunk.offset = in.Take<std::uint64_t>();
        chunk.size = in.Take<std::uint64_t>();
        chunks_.push_back(chunk);
        break;
      }
      case McapOp::kChunk: {
        if (in_summary) throw RecordError("a chunk in the summary");
        Chunk chunk{.offset = record.offset};
        CountUnpacked(record.content, &scanned_);
        NoteInChunk(record.offset, UnpackChunk(record.content), &chunk);
        chunks_.push_back(chunk);
        break;
      }
      case McapOp::kMessage: {
        Chunk bare{.offset = record.offset, .bare = true};
        NoteMessage(TakeMessage(&in), &bare);
        chunks_.push_back(bare);
        break;
      }
      case McapOp::kAttachment: {
        McapAttachment attachment{.offset = record.offset};
        attachment.log_time = in.Take<std::uint64_t>();
        in.Take<std::uint64_t>();
        attachment.name = in.TakeString();
        attachment.media_type = in.TakeString();
        attachment.size = in.Take<std::uint64_t>();
        contents_.attachments.push_back(std::move(attachment));
        break;
      }
      case McapOp::kAttachmentIndex: {
        McapAttachment attachment;
        attachment.offset = in.Take<std::uint64_t>();
        in.Take<std::uint64_t>();
        attachment.log_time = in.Take<std::uint64_t>();
        in.Take<std::uint64_t>();
        attachment.size = in.Take<std::uint64_t>();
        attachment.name = in.TakeString();
        attachment.media_type = in.TakeString();
        contents_.attachments.push_back(std::move(attachment));
        break;
      }
      case McapOp::kMetadata: {
        const std::string name = in.TakeString();
        contents_.metadata[name] = in.TakeMap();
        break;
      }
      case McapOp::kMetadataIndex: {
        const auto offset = in.Take<std::uint64_t>();
        const Record metadata = ReadRecord(offset);
        if (metadata.op != McapOp::kMetadata) throw RecordError("an index names no metadata");
        indexed_ += metadata.content.size();
        if (indexed_ > size_) throw RecordError("indexes name more metadata than the file has");
        Note(metadata, in_summary);
        break;
      }
      default:
        break;  // not needed here, or of a later version of the format
    }
  } catch (const RecordError& error) {
    Fail(record.offset, error.what());
  }
}

// Before it is unpacked, as it says itself: UnpackChunk() holds it to that.
void McapReader::CountUnpacked(ByteSpan chunk, std::uint64_t* sum) const {
  BytesIn in(chunk);
  in.TakeRaw(8 + 8);
  *sum += std::min(in.Take<std::uint64_t>(), MostUnpacked(size_));
  if (*sum > MostUnpacked(size_)) {
    throw RecordError("the file unpacks to more than " + std::to_string(MostUnpacked(size_)) +
                      " bytes");
  }
}

void McapReader::NoteInChunk(std::uint64_t offset, const std::vector<std::byte>& records,
                             Chunk* chunk) {
  BytesIn in(records);
  while (in.remaining() > 0) {
    const auto op = static_cast<McapOp>(in.Take<std::uint8_t>());
    BytesIn content(in.TakeRaw(in.Take<std::uint64_t>()));
    if (op == McapOp::kMessage) {
      NoteMessage(TakeMessage(&content), chunk);
    } else if (op == McapOp::kSchema || op == McapOp::kChannel) {
      const ByteSpan raw = content.TakeRaw(content.remaining());
      Note({.op = op, .offset = offset, .content = {raw.begin(), raw.end()}}, false);
    }
  }
}

void McapReader::NoteMessage(const McapMessage& message, Chunk* chunk) {
  const std::uint64_t time = message.log_time;
  const auto extend = [time](bool first, std::uint64_t* from, std::uint64_t* to) {
    *from = first ? time : std::min(*from, time);
    *to = first ? time : std::max(*to, time);
  };
  extend(contents_.messages == 0, &contents_.first_time, &contents_.last_time);
  extend(chunk->empty, &chunk->first_time, &chunk->last_time);
  chunk->empty = false;
  ++contents_.messages;
  ++contents_.counts[message.channel_id];
}

void McapReader::ReadMessages(std::uint64_t from, std::uint64_t to, const Visit& visit) const {
  const auto tell = [&](std::uint64_t offset, BytesIn content) {
    const McapMessage message = TakeMessage(&content);
    if (message.log_time < from || message.log_time > to) return true;
    const auto channel = contents_.channels.find(message.channel_id);
    if (channel == contents_.channels.end()) {
      Fail(offset, "a message of channel " + std::to_string(message.channel_id) +
                       ", which the file does not describe");
    }
    return visit(channel->second, message);
  };
  std::uint64_t unpacked = 0;
  for (const Chunk& chunk : chunks_) {
    if (chunk.last_time < from || chunk.first_time > to) continue;
    const Record record = ReadRecord(chunk.offset);
    if (chunk.bare) {
      if (!tell(chunk.offset, BytesIn(record.content))) return;
      continue;
    }
    if (record.op == McapOp{}) {
      LeaveOut(chunk.offset, "zeros where a chunk was");
      continue;
    }
    if (record.op != McapOp::kChunk) Fail(chunk.offset, "expected a chunk");
    if (chunk.size != 0 && chunk.size < kMcapRecordHead + record.content.size()) {
      Fail(chunk.offset, "the chunk is larger than its index says");
    }
    try {
      CountUnpacked(record.content, &unpacked);
      const std::vector<std::byte> records = UnpackChunk(record.content);
      BytesIn in(records);
      while (in.remaining() > 0) {
        const auto op = static_cast<McapOp>(in.Take<std::uint8_t>());
        const BytesIn content(in.TakeRaw(in.Take<std::uint64_t>()));
        if (op == McapOp::kMessage && !tell(chunk.offset, content)) return;
      }
    } catch (const ChunkDamage& damage) {
      LeaveOut(chunk.offset, damage.what());
    } catch (const RecordError& error) {
      if (std::string_view(error.what()).starts_with(path().string())) throw;
      Fail(chunk.offset, error.what());
    }
  }
}

// Keeps the first reason.
void McapReader::LeaveOut(std::uint64_t offset, const std::string& why) const {
  if (!contents_.cut_short.empty()) return;
  contents_.cut_short = path().string() + ": at byte " + std::to_string(offset) + ": " + why +
                        "; what it held is left out";
}

std::vector<std::byte> McapReader::ReadAttachment(std::string_view name) const {
  const auto found = std::ranges::find(contents_.attachments, name, &McapAttachment::name);
  if (found == contents_.attachments.end()) {
    throw RecordError(path().string() + ": holds no attachment " + std::string(name));
  }
  const Record record = ReadRecord(found->offset);
  if (record.op != McapOp::kAttachment) Fail(found->offset, "expected an attachment");
  BytesIn in(record.content);
  try {
    in.TakeRaw(8 + 8);
    in.TakeString();
    in.TakeString();
    const ByteSpan data = in.TakeRaw(in.Take<std::uint64_t>());
    const std::size_t checked = in.position();
    const auto crc = in.Take<std::uint32_t>();
    if (crc != 0 && Crc32(ByteSpan(record.content).first(checked)) != crc) {
      throw RecordError("the attachment's checksum is wrong");
    }
    return {data.begin(), data.end()};
  } catch (const RecordError& error) {
    Fail(found->offset, error.what());
  }
}

McapReader::Record McapReader::ReadRecord(std::uint64_t offset) const {
  if (offset > size_ || size_ - offset < kMcapRecordHead) {
    Fail(offset, "the file ends where a record should begin");
  }
  const std::vector<std::byte> head = Read(offset, kMcapRecordHead);
  BytesIn in(head);
  const auto op = static_cast<McapOp>(in.Take<std::uint8_t>());
  const auto size = in.Take<std::uint64_t>();
  if (size > size_ - offset - kMcapRecordHead) {
    Fail(offset, "a record of " + std::to_string(size) + " bytes, of which the file holds " +
                     std::to_string(size_ - offset - kMcapRecordHead));
  }
  if (size > kMostRecord) {
    Fail(offset, "a record of " + std::to_string(size) + " bytes; at most " +
                     std::to_string(kMostRecord) + " are read");
  }
  return {.op = op, .offset = offset, .content = Read(offset + kMcapRecordHead, size)};
}

std::vector<std::byte> McapReader::Read(std::uint64_t offset, std::uint64_t size) const {
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t got = ::pread(fd_.get(), bytes.data() + done, bytes.size() - done,
                                static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) Fail(offset, std::strerror(errno));  // NOLINT(concurrency-mt-unsafe)
    if (got == 0) Fail(offset, "the file has become shorter");
    done += static_cast<std::size_t>(got);
  }
  return bytes;
}

void McapReader::Fail(std::uint64_t offset, const std::string& what) const {
  throw RecordError(path().string() + ": at byte " + std::to_string(offset) + ": " + what);
}

}  // namespace understudy::record
