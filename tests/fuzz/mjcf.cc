// Bytes as a model: read, rewritten for MuJoCo 2, freed of looks, joined with itself and written.
// MuJoCo's own compiler is not ours to fuzz.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/errors.h"
#include "mjcf/document.h"
#include "mjcf/join.h"
#include "mjcf/looks.h"
#include "mjcf/rewrite.h"
#include "tests/fuzz/memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace understudy;  // NOLINT(google-build-using-namespace)
  static test::MemoryFile file;
  try {
    mjcf::MjcfElement root = mjcf::ReadMjcf(file.Write({data, size}));
    std::vector<mjcf::Rewrite> rewrites;
    mjcf::RewriteForMujoco2(&root, &rewrites);
    mjcf::LeaveOutLooks(&root);
    mjcf::MjcfElement other = root;
    mjcf::AddPrefix("a/", &root);
    mjcf::AddPrefix("b/", &other);
    mjcf::MoveBodies(1, 2, &other);
    std::vector<std::string> warnings;
    mjcf::Join(std::move(other), &root, &warnings);
    mjcf::WriteMjcf(root);
  } catch (const SetupError&) {
    // What most bytes are, said in words.
  }
  return 0;
}
