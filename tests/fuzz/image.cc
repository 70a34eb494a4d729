// Bytes as the picture of a terrain's heights.
#include "terrain/image.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "base/errors.h"
#include "tests/fuzz/memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace understudy;  // NOLINT(google-build-using-namespace)
  static test::MemoryFile file;
  try {
    const terrain::GreyImage image = terrain::ReadGreyImage(file.Write({data, size}));
    const auto pixels =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    if (image.grey.size() != pixels) std::abort();
  } catch (const SetupError&) {
    // What most bytes are, said in words.
  }
  return 0;
}
