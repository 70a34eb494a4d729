// Bytes as a URDF, and what is one written as MJCF.
#include <cstddef>
#include <cstdint>

#include "base/errors.h"
#include "mjcf/urdf_reader.h"
#include "tests/fuzz/memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace understudy;  // NOLINT(google-build-using-namespace)
  static test::MemoryFile file;
  try {
    mjcf::IndentedMjcf(mjcf::ReadUrdf(file.Write({data, size})).model, "");
  } catch (const SetupError&) {
    // What most bytes are, said in words.
  }
  return 0;
}
