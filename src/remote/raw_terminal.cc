#include "remote/raw_terminal.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/errors.h"

namespace understudy::remote {
namespace {

// Another screen, no cursor, tell of lost focus; all keys as sequences with their releases (kitty
// keyboard protocol: 1 + 2 + 8), and ask whether that was understood.
constexpr std::string_view kEnter = "\033[?1049h\033[?25l\033[?1004h\033[>11u\033[?u";
constexpr std::string_view kLeave = "\033[<u\033[?1004l\033[?25h\033[?1049l";

// All of it, whatever signals come. Async-signal-safe.
void WriteAll(std::string_view text) {
  while (!text.empty()) {
    const ssize_t wrote = ::write(STDOUT_FILENO, text.data(), text.size());
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) return;  // nobody looks any more
    text.remove_prefix(static_cast<std::size_t>(wrote));
  }
}

bool Same(const termios& one, const termios& other) {
  return one.c_iflag == other.c_iflag && one.c_oflag == other.c_oflag &&
         one.c_lflag == other.c_lflag && std::memcmp(one.c_cc, other.c_cc, sizeof one.c_cc) == 0;
}

SetupError Refusal(const char* what) {
  return SetupError(std::string("terminal: ") + what + ": " +
                    std::generic_category().message(errno));
}

}  // namespace

RawTerminal::RawTerminal() {
  if (::tcgetattr(STDIN_FILENO, &before_) != 0) throw Refusal("its settings");
  ours_ = before_;
  ours_.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO | IEXTEN);
  ours_.c_iflag &= ~static_cast<tcflag_t>(ICRNL | IXON);
  ours_.c_cc[VMIN] = 0;
  ours_.c_cc[VTIME] = 0;
  ours_.c_cc[VSUSP] = _POSIX_VDISABLE;
  StartGuardian();
  if (::tcsetattr(STDIN_FILENO, TCSADRAIN, &ours_) != 0) throw Refusal("its settings");
  WriteAll(kEnter);
}

RawTerminal::~RawTerminal() {
  WriteAll(kLeave);
  ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &before_);
  guardian_.reset();
  ::waitpid(guardian_pid_, nullptr, 0);
}

void RawTerminal::StartGuardian() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw Refusal("a pipe");
  guardian_ = UniqueFd(ends[1]);
  const UniqueFd watched(ends[0]);
  // Blocked until the guardian ignores them: Ctrl-C is for us alone.
  sigset_t all;
  sigset_t mask;
  ::sigfillset(&all);
  ::sigprocmask(SIG_SETMASK, &all, &mask);
  guardian_pid_ = ::fork();
  if (guardian_pid_ == 0) {
    // All signals stay blocked, SIGTTOU too: the terminal may be another program's by then.
    guardian_.reset();
    char byte = 0;
    while (::read(watched.get(), &byte, 1) < 0 && errno == EINTR) {
    }
    termios now{};
    if (::tcgetattr(STDIN_FILENO, &now) == 0 && Same(now, ours_)) {
      WriteAll(kLeave);
      ::tcsetattr(STDIN_FILENO, TCSANOW, &before_);
    }
    ::_exit(0);
  }
  ::sigprocmask(SIG_SETMASK, &mask, nullptr);
  if (guardian_pid_ < 0) throw Refusal("a process");
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
