#include "exec/program_output.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include "exec/command.h"

namespace understudy::exec {
namespace {

// All *assumed*.
constexpr int kGlance = 50;                 // ms after which the end is looked for
constexpr std::size_t kLongestLine = 4096;  // bytes; of a longer one the last are kept

[[noreturn]] void Fail(const char* what) {
  throw CommandError(std::string("nothing takes what the program prints: ") + what + ": " +
                         std::generic_category().message(errno),
                     kExitOwnFailure);
}

// Returns false if nobody reads any more.
bool WriteAll(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

ProgramOutput::ProgramOutput(const std::vector<std::string>& texts, int to) : to_(to) {
  for (const std::string& text : texts) texts_.emplace_back(text);
  if (to == STDERR_FILENO && ::isatty(to) != 1) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) Fail("pipe");
    ours_ = UniqueFd(ends[0]);
    program_ = UniqueFd(ends[1]);
    return;
  }
  ours_ = UniqueFd(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC));
  if (!ours_.valid()) Fail("posix_openpt");
  std::array<char, 64> name{};
  if (::grantpt(ours_.get()) != 0 || ::unlockpt(ours_.get()) != 0 ||
      ::ptsname_r(ours_.get(), name.data(), name.size()) != 0) {
    Fail("ptsname");
  }
  program_ = UniqueFd(::open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC));
  if (!program_.valid()) Fail(name.data());
  // Bytes pass as they are; our own terminal, if there is one, sees to the ends of lines.
  termios mode{};
  if (::tcgetattr(program_.get(), &mode) != 0) Fail("tcgetattr");
  ::cfmakeraw(&mode);
  if (::tcsetattr(program_.get(), TCSANOW, &mode) != 0) Fail("tcsetattr");
  winsize size{};
  if (::ioctl(to, TIOCGWINSZ, &size) == 0) ::ioctl(program_.get(), TIOCSWINSZ, &size);
}

void ProgramOutput::Finish() {
  if (!thread_.joinable()) return;
  thread_.request_stop();
  thread_.join();
  EndLine();
}

void ProgramOutput::Start() {
  program_.reset();  // else the end of the program's would not be seen
  thread_ = std::jthread([this](const std::stop_token& stop) { Read(stop); });
}

void ProgramOutput::Read(const std::stop_token& stop) {
  // Signals are the main thread's; a reader that has gone is an error of write.
  sigset_t all;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_BLOCK, &all, nullptr);
  bool heard = true;
  std::array<char, 4096> bytes{};
  while (true) {
    const bool last = stop.stop_requested();
    pollfd ready{.fd = ours_.get(), .events = POLLIN, .revents = 0};
    const int count = ::poll(&ready, 1, last ? 0 : kGlance);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0 && last) return;
    if (count <= 0) continue;
    const ssize_t got = ::read(ours_.get(), bytes.data(), bytes.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return;  // EIO: nobody has the other end any more
    const std::string_view text(bytes.data(), static_cast<std::size_t>(got));
    Search(text);
    heard = heard && WriteAll(to_, text);
  }
}

void ProgramOutput::Search(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\n');
    line_ += bytes.substr(0, end);
    for (Text& text : texts_) {
      if (text.in_line || line_.find(text.text) == std::string::npos) continue;
      text.in_line = true;
      text.found.fetch_add(1, std::memory_order_release);
    }
    if (line_.size() > kLongestLine) line_.erase(0, line_.size() - kLongestLine / 2);
    if (end == std::string_view::npos) return;
    EndLine();
    bytes.remove_prefix(end + 1);
  }
}

void ProgramOutput::EndLine() {
  if (line_.find_first_not_of(" \t\r") != std::string::npos) last_line_ = line_;
  line_.clear();
  for (Text& text : texts_) text.in_line = false;
}

}  // namespace understudy::exec
