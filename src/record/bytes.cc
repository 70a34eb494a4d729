#include "record/bytes.h"

namespace understudy::record {

// Not inline: GCC 12 would assume sizes that it cannot know, and warn.
void BytesOut::PutRaw(ByteSpan raw) { bytes_.insert(bytes_.end(), raw.begin(), raw.end()); }

}  // namespace understudy::record
