// Puts the terminal into raw mode, for single keys and a full-screen picture.
#pragma once

#include <string>
#include <string_view>

#include <termios.h>

namespace understudy::remote {

// While it exists, keys arrive one by one without echo, the picture is on the alternate screen and
// the cursor is hidden. Ctrl-C raises SIGINT as usual; Ctrl-Z is ignored, since a stopped program
// would leave the terminal in this mode. SIGKILL leaves it so too: `reset` restores it.
class RawTerminal {
 public:
  // Standard input and output must be a terminal. Throws SetupError if the system refuses.
  RawTerminal();
  ~RawTerminal();
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;

  // Waits for input at most `timeout_ms`. Sets `typed`, "" for none. Returns false if the terminal
  // has gone.
  bool Read(int timeout_ms, std::string* typed);
  void Write(std::string_view text);

  int columns() const;
  int rows() const;

 private:
  termios before_{};
};

}  // namespace understudy::remote
