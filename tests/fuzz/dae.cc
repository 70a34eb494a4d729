// Bytes as COLLADA.
#include "mjcf/dae.h"

#include <cstddef>
#include <cstdint>

#include "base/errors.h"
#include "tests/fuzz/memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace understudy;  // NOLINT(google-build-using-namespace)
  static test::MemoryFile file;
  try {
    mjcf::ReadDae(file.Write({data, size}));
  } catch (const SetupError&) {
    // What most bytes are, said in words.
  }
  return 0;
}
