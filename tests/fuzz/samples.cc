// Bytes as the CSV of a recording for `identify`.
#include "identify/samples.h"

#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "base/errors.h"
#include "config/load.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tiny_robot.h"

namespace {

understudy::config::Config TinyRobot() {
  const understudy::test::TemporaryFolder folder;
  const auto file = folder.Write("tiny.yaml", understudy::test::kTinyRobot);
  return understudy::config::LoadConfig({.robot = file.string()}, UNDERSTUDY_SOURCE_DIR);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace understudy;  // NOLINT(google-build-using-namespace)
  static const config::Config tiny = TinyRobot();
  try {
    std::istringstream text(std::string(reinterpret_cast<const char*>(data), size));
    identify::ReadCsv(text, "fuzz.csv", tiny.robots[0].spec);
  } catch (const SetupError&) {
    // What most bytes are, said in words.
  }
  return 0;
}
