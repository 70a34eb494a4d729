#include "record/mcap_format.h"

#include <zstd.h>

namespace understudy::record {
namespace {

// The largest uncompressed size of a chunk; *assumed*, many times that of common writers.
constexpr std::uint64_t kMostUnpacked = 256 << 20;

}  // namespace

McapMessage TakeMessage(BytesIn* in) {
  McapMessage message;
  message.channel_id = in->Take<std::uint16_t>();
  message.sequence = in->Take<std::uint32_t>();
  message.log_time = in->Take<std::uint64_t>();
  message.publish_time = in->Take<std::uint64_t>();
  message.data = in->TakeRaw(in->remaining());
  return message;
}

McapSchema TakeSchema(BytesIn* in) {
  McapSchema schema;
  schema.id = in->Take<std::uint16_t>();
  schema.name = in->TakeString();
  schema.encoding = in->TakeString();
  schema.data = in->TakeString();
  return schema;
}

McapChannel TakeChannel(BytesIn* in) {
  McapChannel channel;
  channel.id = in->Take<std::uint16_t>();
  channel.schema_id = in->Take<std::uint16_t>();
  channel.topic = in->TakeString();
  channel.encoding = in->TakeString();
  channel.metadata = in->TakeMap();
  return channel;
}

std::vector<std::byte> UnpackChunk(ByteSpan content) {
  BytesIn in(content);
  in.TakeRaw(8 + 8);
  const auto size = in.Take<std::uint64_t>();
  const auto crc = in.Take<std::uint32_t>();
  const std::string compression = in.TakeString();
  const ByteSpan packed = in.TakeRaw(in.Take<std::uint64_t>());
  if (size > kMostUnpacked) {
    throw RecordError("a chunk of " + std::to_string(size) + " bytes; at most " +
                      std::to_string(kMostUnpacked) + " are unpacked");
  }
  std::vector<std::byte> records;
  if (compression.empty()) {
    records.assign(packed.begin(), packed.end());
  } else if (compression == "zstd") {
    records.resize(static_cast<std::size_t>(size));
    const std::size_t unpacked =
        ZSTD_decompress(records.data(), records.size(), packed.data(), packed.size());
    if (ZSTD_isError(unpacked) != 0) {
      throw ChunkDamage(std::string("a chunk does not unpack: ") + ZSTD_getErrorName(unpacked));
    }
    records.resize(unpacked);
  } else {
    throw RecordError("a chunk packed with " + compression +
                      "; expected zstd or none (`mcap compress` of the MCAP project converts)");
  }
  if (records.size() != size) {
    throw ChunkDamage("a chunk unpacks to " + std::to_string(records.size()) + " bytes, not " +
                      std::to_string(size));
  }
  if (crc != 0 && Crc32(records) != crc) throw ChunkDamage("a chunk's checksum is wrong");
  return records;
}

}  // namespace understudy::record
