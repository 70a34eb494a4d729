// What reader and writer of MCAP share (https://mcap.dev/spec).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "record/bytes.h"

namespace understudy::record {

// At the beginning and at the end of every file.
inline constexpr std::array<unsigned char, 8> kMcapMagic = {0x89, 'M', 'C',  'A',
                                                            'P',  '0', '\r', '\n'};

// The first byte of a record; its length follows as uint64.
enum class McapOp : std::uint8_t {
  kHeader = 1,
  kFooter = 2,
  kSchema = 3,
  kChannel = 4,
  kMessage = 5,
  kChunk = 6,
  kMessageIndex = 7,
  kChunkIndex = 8,
  kAttachment = 9,
  kAttachmentIndex = 10,
  kStatistics = 11,
  kMetadata = 12,
  kMetadataIndex = 13,
  kSummaryOffset = 14,
  kDataEnd = 15,
};

inline constexpr std::size_t kMcapRecordHead = 1 + 8;  // opcode and length
inline constexpr std::size_t kMcapMessageHead = 2 + 4 + 8 + 8;
inline constexpr std::size_t kMcapFooter = 8 + 8 + 4;  // without its head

struct McapSchema {
  std::uint16_t id = 0;  // never 0 in a file: 0 is a channel's "no schema"
  std::string name;      // "unitree_go/msg/LowState"
  std::string encoding;  // "ros2msg"
  std::string data;
};

struct McapChannel {
  std::uint16_t id = 0;
  std::uint16_t schema_id = 0;
  std::string topic;
  std::string encoding;  // of its messages: "cdr"
  StringMap metadata;
};

// Times are ns since 1970.
struct McapMessage {
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time = 0;
  std::uint64_t publish_time = 0;
  ByteSpan data;  // of whoever gave the message
};

// CRC-32 of ISO 3309, going on from `crc`, which is 0 at the start.
std::uint32_t Crc32(ByteSpan bytes, std::uint32_t crc = 0);

// Each takes the whole content of such a record. Throws RecordError where it is shorter than it
// says.
McapMessage TakeMessage(BytesIn* in);  // its data points into what `in` reads
McapSchema TakeSchema(BytesIn* in);
McapChannel TakeChannel(BytesIn* in);

// The records in a chunk of this content. Throws RecordError: too large, packed otherwise than by
// zstd or not at all, another size or checksum than it says.
std::vector<std::byte> UnpackChunk(ByteSpan content);

}  // namespace understudy::record
