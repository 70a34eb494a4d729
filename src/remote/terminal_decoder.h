// Turns the bytes that a terminal sends into keys.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace understudy::remote {

// Keys that are no character; beyond Unicode.
inline constexpr char32_t kUpKey = 0x110000;
inline constexpr char32_t kDownKey = 0x110001;
inline constexpr char32_t kRightKey = 0x110002;
inline constexpr char32_t kLeftKey = 0x110003;
inline constexpr char32_t kEnterKey = U'\r';
inline constexpr char32_t kTabKey = U'\t';
inline constexpr char32_t kEscapeKey = U'\x1b';

// A key that was pressed, or repeats: a terminal does not say which, nor when it is released.
struct TerminalKey {
  char32_t key = 0;  // without shift: 'a' for A
  bool shift = false;
  bool control = false;

  bool operator==(const TerminalKey&) const = default;
};

// Decodes characters and the arrows of xterm and its kin. Takes any bytes and skips what it does
// not know.
class TerminalDecoder {
 public:
  // Returns the keys that these bytes complete. A sequence may come in parts.
  std::vector<TerminalKey> Feed(std::string_view bytes);
  // Call it when nothing more came for a while: a lone escape byte was the key, not a sequence.
  std::vector<TerminalKey> Pause();

  // Whether the bytes so far end within a sequence.
  bool waits() const { return !pending_.empty(); }

 private:
  std::string pending_;
};

}  // namespace understudy::remote
