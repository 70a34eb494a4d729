// Bytes as what a client of the control plane sends.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "tests/fuzz/control_server.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  understudy::test::TellServer({reinterpret_cast<const char*>(data), size});
  return 0;
}
