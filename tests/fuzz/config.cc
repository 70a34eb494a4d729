// Bytes as YAML, and what is YAML as a configuration over that of the smallest robot: one of twelve
// motors takes three times as long to read.
#include <cstddef>
#include <cstdint>
#include <string>

#include "base/errors.h"
#include "config/load.h"
#include "schema/yaml_document.h"
#include "tests/fuzz/memory_file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tiny_robot.h"

namespace {

understudy::config::RobotFile TinyRobot() {
  const understudy::test::TemporaryFolder folder;
  const auto file = folder.Write("tiny.yaml", understudy::test::kTinyRobot);
  return understudy::config::ReadRobotFile(file.string(), UNDERSTUDY_SOURCE_DIR);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace understudy;  // NOLINT(google-build-using-namespace)
  static test::MemoryFile file;
  static const config::RobotFile tiny = TinyRobot();
  try {
    const std::string text(reinterpret_cast<const char*>(data), size);
    schema::ParseYaml(text, "fuzz.yaml");
    const std::string path = file.Write({data, size});
    const config::Config read = config::LoadConfig(tiny, {.files = {path}}, UNDERSTUDY_SOURCE_DIR);
    config::PrintConfig(read, false);
  } catch (const SetupError&) {
    // What most bytes are, said in words.
  }
  return 0;
}
