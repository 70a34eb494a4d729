// Bytes as campaign.json and as the result of a run, which `--merge` reads: what is one is written
// and read to the same again.
#include "rehearse/campaign.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace understudy;  // NOLINT(google-build-using-namespace)
  const std::string text(reinterpret_cast<const char*>(data), size);
  if (const auto head = rehearse::ParseHead(text)) {
    const std::string written = rehearse::HeadText(*head);
    const auto again = rehearse::ParseHead(written);
    if (!again || rehearse::HeadText(*again) != written) std::abort();
  }
  if (const auto run = rehearse::ParseRun(text)) {
    const std::string written = rehearse::RunLine(*run);
    const auto again = rehearse::ParseRun(written);
    if (!again || rehearse::RunLine(*again) != written) std::abort();
  }
  return 0;
}
