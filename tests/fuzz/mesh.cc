// Bytes as OBJ, PLY and STL.
#include <cstddef>
#include <cstdint>

#include "base/errors.h"
#include "mjcf/mesh_file.h"
#include "tests/fuzz/memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace understudy;  // NOLINT(google-build-using-namespace)
  static test::MemoryFile file;
  const std::filesystem::path path = file.Write({data, size});
  for (auto* const read : {mjcf::ReadObj, mjcf::ReadPly, mjcf::ReadStl}) {
    try {
      read(path);
    } catch (const SetupError&) {
      // What most bytes are, said in words.
    }
  }
  return 0;
}
