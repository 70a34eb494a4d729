// What a client sends on a WebSocket after the handshake. The first byte chooses the route, and
// whether the rest is frames as it is or the text of one.
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>

#include "tests/fuzz/control_server.h"

namespace {

// A final text frame, masked by zeros.
std::string TextFrame(std::string_view text) {
  std::string frame = "\x81";
  if (text.size() < 126) {
    frame += static_cast<char>(0x80U | text.size());
  } else {
    frame += static_cast<char>(0xfe);
    frame += static_cast<char>(text.size() >> 8U);
    frame += static_cast<char>(text.size());
  }
  return frame + std::string(4, '\0') + std::string(text);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr const char* kRoutes[] = {"/requests", "/events", "/snapshots?hz=50"};
  constexpr std::size_t kLongestFrame = 65535;
  if (size < 1 || size > kLongestFrame) return 0;
  const std::string_view rest(reinterpret_cast<const char*>(data) + 1, size - 1);
  const bool raw = (data[0] & 0x80U) != 0;
  understudy::test::TellServer(std::string("GET ") + kRoutes[data[0] % std::size(kRoutes)] +
                               " HTTP/1.1\r\nHost: x\r\nUpgrade: websocket\r\n"
                               "Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                               "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n" +
                               (raw ? std::string(rest) : TextFrame(rest)));
  return 0;
}
