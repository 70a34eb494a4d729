// Bytes as a ROS 2 bag of SQLite, or as what zstd compressed: contents and all messages.
#include <cstddef>
#include <cstdint>

#include "base/errors.h"
#include "record/recording_reader.h"
#include "tests/fuzz/memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace understudy;  // NOLINT(google-build-using-namespace)
  static test::MemoryFile file;
  try {
    const auto reader = record::OpenRecording(file.Write({data, size}));
    reader->ReadMessages(
        [](const record::McapChannel&, const record::McapMessage&) { return true; });
  } catch (const SetupError&) {
    // What most bytes are, said in words.
  }
  return 0;
}
