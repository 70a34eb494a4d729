// What stands in single records of MCAP.
#pragma once

#include <cstddef>
#include <vector>

#include "record/mcap_format.h"

namespace understudy::record {

// Each takes the whole content of such a record. Throws RecordError where it is shorter than it
// says.
McapMessage TakeMessage(BytesIn* in);  // its data points into what `in` reads
McapSchema TakeSchema(BytesIn* in);
McapChannel TakeChannel(BytesIn* in);

// The records in a chunk of this content. Throws RecordError: too large, packed otherwise than by
// zstd or not at all, another size or checksum than it says.
std::vector<std::byte> UnpackChunk(ByteSpan content);

}  // namespace understudy::record
