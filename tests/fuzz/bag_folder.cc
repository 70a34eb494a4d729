// Bytes as metadata.yaml of a bag's folder, in which a recording without messages is.
#include "record/bag_folder.h"

#include <cstddef>
#include <cstdint>
#include <fstream>

#include "base/errors.h"
#include "record/mcap_writer.h"
#include "tests/support/temporary_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace understudy;  // NOLINT(google-build-using-namespace)
  static const test::TemporaryFolder folder;
  static const bool written = [] {
    record::McapWriter writer(record::OutputFile(folder.path() / "run.mcap", true), "ros2", "fuzz",
                              {});
    writer.Finish();
    return true;
  }();
  static_cast<void>(written);
  try {
    std::ofstream(folder.path() / "metadata.yaml", std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    const record::BagFolder bag(folder.path());
    bag.ReadMessages([](const record::McapChannel&, const record::McapMessage&) { return true; });
  } catch (const SetupError&) {
    // What most bytes are, said in words.
  }
  return 0;
}
