// Bytes as YAML, and what is YAML as a configuration over that of a Go2, and as a robot's file.
#include <cstddef>
#include <cstdint>
#include <string>

#include "base/errors.h"
#include "config/load.h"
#include "config/yaml_document.h"
#include "tests/fuzz/memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace understudy;  // NOLINT(google-build-using-namespace)
  static test::MemoryFile file;
  static const config::RobotFile go2 = config::ReadRobotFile("go2", UNDERSTUDY_SOURCE_DIR);
  try {
    const std::string text(reinterpret_cast<const char*>(data), size);
    config::ParseYaml(text, "fuzz.yaml");
    const std::string path = file.Write({data, size});
    const config::Config read = config::LoadConfig(go2, {.files = {path}}, UNDERSTUDY_SOURCE_DIR);
    config::PrintConfig(read, false);
  } catch (const SetupError&) {
    // What most bytes are, said in words.
  }
  return 0;
}
