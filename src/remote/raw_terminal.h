// The terminal while it is a remote controller.
#ifndef UNDERSTUDY_REMOTE_RAW_TERMINAL_H_
#define UNDERSTUDY_REMOTE_RAW_TERMINAL_H_

#include <string>
#include <string_view>

#include <sys/types.h>
#include <termios.h>

#include "base/unique_fd.h"

namespace understudy::remote {

// From construction to destruction: keys come one by one, without echo; the screen is another one
// and the cursor is hidden; releases are told by terminals that can; Ctrl-C is SIGINT as ever, and
// Ctrl-Z does nothing, for a stopped program would leave the terminal so.
//
// A second process waits for the end of this one, whatever that is (SIGKILL, a bug), and puts the
// terminal back where nobody else has done so.
class RawTerminal {
 public:
  // Standard input and output must be a terminal. Call it before any thread exists. Throws
  // SetupError where the system refuses.
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
  void StartGuardian();

  termios before_{};
  termios ours_{};
  UniqueFd guardian_;  // closed, by us or by our end: the guardian's signal
  pid_t guardian_pid_ = 0;
};

}  // namespace understudy::remote

#endif  // UNDERSTUDY_REMOTE_RAW_TERMINAL_H_
