// Opens the panel in the browser of the user who runs the robot.
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include <sys/types.h>

namespace understudy::commands {

// Opens an address by xdg-open. The address has the run's token in it, which other users of the
// machine must not see in a list of processes: the browser is given a page that leads there, which
// only this user can read and which goes with this object.
class Browser {
 public:
  // `page` is a file that does not matter, in a folder of the user's own.
  explicit Browser(std::filesystem::path page) : page_(std::move(page)) {}
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  // Starts xdg-open; logs the address, and why, if it cannot. Never waits.
  void Open(const std::string& url);
  // Logs the address once if xdg-open has failed.
  void Watch();

 private:
  void SayInstead(const std::string& why);

  std::filesystem::path page_;
  std::string url_;
  pid_t pid_ = -1;
};

}  // namespace understudy::commands
