// The MCAP format (docs/dev/sources.md#algorithms-and-training-environments): records that reader
// and writer share.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/errors.h"
#include "record/bytes.h"

namespace understudy::record {

// The first and the last bytes of every file.
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
inline constexpr std::size_t kMcapFooter = 8 + 8 + 4;  // without the record head

struct McapSchema {
  std::uint16_t id = 0;  // not 0: a channel with schema_id 0 has no schema
  std::string name;      // "unitree_go/msg/LowState"
  std::string encoding;  // "ros2msg"
  std::string data;
};

struct McapChannel {
  std::uint16_t id = 0;
  std::uint16_t schema_id = 0;
  std::string topic;
  std::string encoding;  // message encoding: "cdr"
  StringMap metadata;
};

// Times are ns since 1970.
struct McapMessage {
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time = 0;
  std::uint64_t publish_time = 0;
  ByteSpan data;  // owned by the source of the message
};

// Continues the CRC-32 (ISO 3309) `crc`, which is 0 at the start.
std::uint32_t Crc32(ByteSpan bytes, std::uint32_t crc = 0);

// Each reads the content of one record. Throws RecordError if the content is shorter than its
// fields say.
McapMessage TakeMessage(BytesIn* in);  // its data points into what `in` reads
McapSchema TakeSchema(BytesIn* in);
McapChannel TakeChannel(BytesIn* in);

// A chunk that is not as it was written: its checksum or its size are wrong, or it does not unpack.
class ChunkDamage : public RecordError {
 public:
  using RecordError::RecordError;
};

// Returns the records of a chunk. Throws ChunkDamage, and RecordError if the chunk is too large or
// has another compression than zstd or none.
std::vector<std::byte> UnpackChunk(ByteSpan content);

}  // namespace understudy::record
