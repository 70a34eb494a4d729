// Bytes as a terminal sends them: in parts they are the same keys as at once.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "remote/terminal_decoder.h"

namespace {

using understudy::remote::TerminalDecoder;
using understudy::remote::TerminalKey;

void Append(const std::vector<TerminalKey>& more, std::vector<TerminalKey>* keys) {
  keys->insert(keys->end(), more.begin(), more.end());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  TerminalDecoder whole, parts;
  std::vector<TerminalKey> keys = whole.Feed(bytes), same;
  for (const char& byte : bytes) Append(parts.Feed({&byte, 1}), &same);
  Append(whole.Pause(), &keys);
  Append(parts.Pause(), &same);
  if (keys != same) std::abort();
  return 0;
}
