#include "commands/browser.h"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <sched.h>
#include <spawn.h>
#include <spdlog/spdlog.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/unique_fd.h"

namespace understudy::commands {

Browser::~Browser() {
  std::error_code gone;
  std::filesystem::remove(page_, gone);
}

void Browser::SayInstead(const std::string& why) {
  spdlog::warn("no browser could be opened ({}); the panel is at {}", why, url_);
}

void Browser::Open(const std::string& url) {
  url_ = url;
  if (url.empty()) return;  // why there is no panel has been said
  std::error_code gone;
  std::filesystem::remove(page_, gone);
  const UniqueFd file(::open(page_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
  const std::string text =
      "<!doctype html><meta http-equiv=\"refresh\" content=\"0; url=" + url + "\">\n";
  if (file.get() < 0 ||
      ::write(file.get(), text.data(), text.size()) != static_cast<ssize_t>(text.size())) {
    return SayInstead(page_.string() + ": " + std::strerror(errno));
  }
  std::string program = "xdg-open", page = page_.string();
  char* const words[] = {program.data(), page.data(), nullptr};
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    ::posix_spawn_file_actions_addopen(&actions, descriptor, "/dev/null", O_RDWR, 0);
  }
  // Nothing of what the thread of the tick has: priority, signals that it leaves to others.
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  const sched_param plain{};
  sigset_t none;
  ::sigemptyset(&none);
  ::posix_spawnattr_setschedparam(&attributes, &plain);
  ::posix_spawnattr_setschedpolicy(&attributes, SCHED_OTHER);
  ::posix_spawnattr_setsigmask(&attributes, &none);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSCHEDULER | POSIX_SPAWN_SETSIGMASK);
  const int failed = ::posix_spawnp(&pid_, words[0], &actions, &attributes, words, environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&actions);
  if (failed == 0) return;
  pid_ = -1;
  SayInstead(failed == ENOENT ? "there is no xdg-open; apt-get install xdg-utils"
                              : std::string("xdg-open: ") + std::strerror(failed));
}

void Browser::Watch() {
  int status = 0;
  if (pid_ < 0 || ::waitpid(pid_, &status, WNOHANG) != pid_) return;
  pid_ = -1;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  SayInstead(WIFEXITED(status) ? "xdg-open ended with code " + std::to_string(WEXITSTATUS(status))
                               : "xdg-open was ended");
}

}  // namespace understudy::commands
