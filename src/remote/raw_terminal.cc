#include "remote/raw_terminal.h"

#include <array>
#include <cerrno>
#include <system_error>

#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "base/errors.h"

namespace understudy::remote {
namespace {

// The alternate screen, no cursor; and back.
constexpr std::string_view kEnter = "\033[?1049h\033[?25l";
constexpr std::string_view kLeave = "\033[?25h\033[?1049l";

// Writes the whole text in spite of signals.
void WriteAll(std::string_view text) {
  while (!text.empty()) {
    const ssize_t wrote = ::write(STDOUT_FILENO, text.data(), text.size());
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) return;  // the terminal has gone
    text.remove_prefix(static_cast<std::size_t>(wrote));
  }
}

SetupError Refusal(const char* what) {
  return SetupError(std::string("terminal: ") + what + ": " +
                    std::generic_category().message(errno));
}

}  // namespace

RawTerminal::RawTerminal() {
  if (::tcgetattr(STDIN_FILENO, &before_) != 0) throw Refusal("its settings");
  termios ours = before_;
  ours.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO | IEXTEN);
  ours.c_iflag &= ~static_cast<tcflag_t>(ICRNL | IXON);
  ours.c_cc[VMIN] = 0;
  ours.c_cc[VTIME] = 0;
  ours.c_cc[VSUSP] = _POSIX_VDISABLE;
  if (::tcsetattr(STDIN_FILENO, TCSADRAIN, &ours) != 0) throw Refusal("its settings");
  WriteAll(kEnter);
}

RawTerminal::~RawTerminal() {
  WriteAll(kLeave);
  ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &before_);
}

bool RawTerminal::Read(int timeout_ms, std::string* typed) {
  typed->clear();
  pollfd terminal{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
  if (::poll(&terminal, 1, timeout_ms) <= 0) return true;  // nothing, or a signal
  std::array<char, 512> bytes;
  const ssize_t got = ::read(STDIN_FILENO, bytes.data(), bytes.size());
  if (got > 0) typed->assign(bytes.data(), static_cast<std::size_t>(got));
  if (got < 0 && (errno == EINTR || errno == EAGAIN)) return true;
  return got > 0 || (terminal.revents & POLLHUP) == 0;
}

void RawTerminal::Write(std::string_view text) { WriteAll(text); }

int RawTerminal::columns() const {
  winsize size{};
  return ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

int RawTerminal::rows() const {
  winsize size{};
  return ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_row > 0 ? size.ws_row : 24;
}

}  // namespace understudy::remote
