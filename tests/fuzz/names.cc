// Bytes as a name that discovery tells, a bag or a URDF has: as it is printed, it is one line
// without anything that a terminal takes for a command.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "base/printed.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  for (const char c : understudy::Printable(text)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) std::abort();
  }
  return 0;
}
