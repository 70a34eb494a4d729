// A terminal that gives its keys one by one and shows a picture.
#pragma once

#include <string>
#include <string_view>

#include <termios.h>

namespace understudy::remote {

// From construction to destruction keys come one by one, without echo; the picture is on the
// alternate screen and the cursor is hidden. Ctrl-C raises SIGINT as ever; Ctrl-Z does nothing,
// since a stopped program would leave the terminal so. SIGKILL leaves it so too: `reset` restores
// it.
class RawTerminal {
 public:
  // Standard input and output must be a terminal. Throws SetupError where the system refuses.
  RawTerminal();
  ~RawTerminal();
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;

  // Waits at most that long; "" when nothing was typed. False: the terminal has gone.
  bool Read(int timeout_ms, std::string* typed);
  void Write(std::string_view text);

  int columns() const;
  int rows() const;

 private:
  termios before_{};
};

}  // namespace understudy::remote
