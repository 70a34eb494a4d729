#include "commands/detach.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/errors.h"
#include "base/files.h"
#include "base/log_line.h"
#include "base/signals.h"

namespace understudy::commands {
namespace {

constexpr int kGlance = 50;  // ms from one look at a signal to the next

[[noreturn]] void Fail(const std::string& what) {
  throw SetupError(what + ": " + std::strerror(errno));
}

// The absolute folder that an environment variable names; "" if it names none.
std::filesystem::path FolderIn(const char* variable) {
  const char* const value = std::getenv(variable);
  return value != nullptr && *value == '/' ? value : "";
}

// Whether the child has said more than the line with its log.
bool IsReady(const std::string& said) {
  const std::size_t end = said.find('\n');
  return end != std::string::npos && end + 1 < said.size();
}

// Returns what the child says until it is ready or has ended. Passes a signal that came meanwhile
// on to it.
std::string Listen(int child, int says) {
  std::string said;
  std::array<char, 256> piece{};
  bool passed = false;
  while (true) {
    if (StopSignal() != 0 && !std::exchange(passed, true)) ::kill(child, StopSignal());
    pollfd one{.fd = says, .events = POLLIN, .revents = 0};
    if (::poll(&one, 1, kGlance) <= 0) continue;
    const ssize_t count = ::read(says, piece.data(), piece.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return said;
    said.append(piece.data(), static_cast<std::size_t>(count));
    if (IsReady(said)) return said;
  }
}

[[noreturn]] void BeParent(int child, UniqueFd says) {
  CatchStopSignals();
  const std::string said = Listen(child, says.get());
  const std::filesystem::path log = said.substr(0, said.find('\n'));
  if (IsReady(said)) {
    const std::string name = log.stem().string();
    std::printf(
        "%s runs in the background, process %d. Its log: %s\n"
        "To read it: understudy ctl --name %s log --follow; to end the robot: understudy ctl "
        "--name %s stop\n",
        name.c_str(), child, log.c_str(), name.c_str(), name.c_str());
    std::exit(std::fflush(stdout) == 0 ? 0 : 1);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!log.empty()) SayErrorText(FileText(log));
  std::exit(WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status));
}

// Removes logs that no run has written for kKept. Those of robots that still run are locked.
void RemoveOldLogs(const std::filesystem::path& folder) {
  constexpr std::chrono::days kKept(14);  // *assumed*
  const auto before = std::filesystem::file_time_type::clock::now() - kKept;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    std::error_code gone;
    if (entry.path().extension() != ".log" || !entry.is_regular_file(gone) ||
        entry.last_write_time(gone) > before) {
      continue;
    }
    const UniqueFd file(::open(entry.path().c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC));
    if (file.get() < 0 || ::flock(file.get(), LOCK_EX | LOCK_NB) != 0) continue;
    ::unlink(entry.path().c_str());
  }
}

// Opens the log and makes it the standard error.
std::filesystem::path MoveToBackground(const std::string& name) {
  ::setsid();
  const std::filesystem::path folder = LogFolder();
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  RemoveOldLogs(folder);
  std::filesystem::path log = folder / (name + ".log");
  const UniqueFd file(::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600));
  const UniqueFd nothing(::open("/dev/null", O_RDWR | O_CLOEXEC));
  if (file.get() < 0) Fail(log.string());
  // Standard error keeps the lock for as long as the run.
  if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0) {
    throw SocketError(log.string() + ": another robot of that name writes it; use another --name");
  }
  if (::ftruncate(file.get(), 0) != 0) Fail(log.string());
  if (nothing.get() < 0) Fail("/dev/null");
  ::dup2(nothing.get(), STDIN_FILENO);
  ::dup2(nothing.get(), STDOUT_FILENO);
  ::dup2(file.get(), STDERR_FILENO);
  return log;
}

}  // namespace

std::filesystem::path LogFolder() {
  if (const auto state = FolderIn("XDG_STATE_HOME"); !state.empty()) return state / "understudy";
  if (const auto home = FolderIn("HOME"); !home.empty()) return home / ".local/state/understudy";
  throw SetupError(
      "--detach: there is no folder for the log, since neither HOME nor XDG_STATE_HOME is set");
}

void Background::Ready() {
  const char word = '+';
  // A parent that has gone meanwhile needs no word.
  [[maybe_unused]] const ssize_t told = ::write(parent_.get(), &word, 1);
  parent_ = UniqueFd();
}

Background Detach(const std::function<std::string()>& name) {
  std::array<int, 2> ends{-1, -1};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) Fail("--detach");
  UniqueFd hears(ends[0]), says(ends[1]);
  const int child = ::fork();
  if (child < 0) Fail("--detach");
  if (child > 0) {
    says = UniqueFd();
    BeParent(child, std::move(hears));
  }
  hears = UniqueFd();
  std::filesystem::path log = MoveToBackground(name());
  const std::string line = log.string() + "\n";
  if (::write(says.get(), line.data(), line.size()) < 0) Fail(log.string());
  return {std::move(log), std::move(says)};
}

}  // namespace understudy::commands
