// Decodes the bytes of a terminal into keys.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace understudy::remote {

// Keys without a character; values beyond Unicode.
inline constexpr char32_t kUpKey = 0x110000;
inline constexpr char32_t kDownKey = 0x110001;
inline constexpr char32_t kRightKey = 0x110002;
inline constexpr char32_t kLeftKey = 0x110003;
inline constexpr char32_t kEnterKey = U'\r';
inline constexpr char32_t kTabKey = U'\t';
inline constexpr char32_t kEscapeKey = U'\x1b';

// A key that was pressed or repeats; a terminal does not distinguish these, nor report the release.
struct TerminalKey {
  char32_t key = 0;  // without shift: 'a' for A
  bool shift = false;
  bool control = false;

  bool operator==(const TerminalKey&) const = default;
};

// Decodes characters and the arrow keys of xterm-like terminals. Skips unknown bytes.
class TerminalDecoder {
 public:
  // Returns the keys that these bytes complete. A sequence may come in parts.
  std::vector<TerminalKey> Feed(std::string_view bytes);
  // Call it after a pause in the input: a single escape byte is then the Esc key, not a sequence.
  std::vector<TerminalKey> Pause();

  // Returns whether the bytes so far end within a sequence.
  bool waits() const { return !pending_.empty() || skips_; }

 private:
  std::string pending_;
  bool skips_ = false;  // the rest of a sequence that is longer than all that are known
};

}  // namespace understudy::remote
