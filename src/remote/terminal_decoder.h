// What a terminal sends -> keys that were pressed.
#ifndef UNDERSTUDY_REMOTE_TERMINAL_DECODER_H_
#define UNDERSTUDY_REMOTE_TERMINAL_DECODER_H_

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

struct TerminalEvent {
  enum class Kind {
    kPress,  // or a repeat of it: an ordinary terminal does not say which
    kRepeat,
    kRelease,
    kFocusLost,        // what is released from now on is not told
    kReportsReleases,  // the terminal speaks the kitty keyboard protocol: releases will be told
  };
  Kind kind = Kind::kPress;
  char32_t key = 0;  // without shift: 'a' for A
  bool shift = false;
  bool control = false;

  bool operator==(const TerminalEvent&) const = default;
};

// Knows the sequences of xterm and its kin and those of the kitty keyboard protocol
// (https://sw.kovidgoyal.net/kitty/keyboard-protocol). Any bytes will do; what it does not know it
// passes over.
class TerminalDecoder {
 public:
  // What these bytes complete. A sequence may come in parts.
  std::vector<TerminalEvent> Feed(std::string_view bytes);
  // Nothing more came for a while: an escape that begins no sequence was the key.
  std::vector<TerminalEvent> Pause();

  bool waits() const { return !pending_.empty(); }

 private:
  std::string pending_;
};

}  // namespace understudy::remote

#endif  // UNDERSTUDY_REMOTE_TERMINAL_DECODER_H_
