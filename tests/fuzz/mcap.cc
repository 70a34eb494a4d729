// Bytes as a recording: contents, all messages, all attachments.
#include <cstddef>
#include <cstdint>

#include "base/errors.h"
#include "record/mcap_reader.h"
#include "tests/fuzz/memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace understudy;  // NOLINT(google-build-using-namespace)
  static test::MemoryFile file;
  try {
    const record::McapReader reader(file.Write({data, size}));
    for (const record::McapAttachment& attachment : reader.contents().attachments) {
      reader.ReadAttachment(attachment.name);
    }
    reader.ReadMessages(
        [](const record::McapChannel&, const record::McapMessage&) { return true; });
  } catch (const SetupError&) {
    // What most bytes are, said in words.
  }
  return 0;
}
