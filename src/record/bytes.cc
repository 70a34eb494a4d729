#include "record/bytes.h"

namespace understudy::record {

// Out of line: inlined, GCC 12 takes sizes for known that are not, and warns.
void BytesOut::PutRaw(ByteSpan raw) { bytes_.insert(bytes_.end(), raw.begin(), raw.end()); }

}  // namespace understudy::record
