// Lets a run go on in the background.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "base/unique_fd.h"

namespace understudy::commands {

// Returns the folder of the logs of runs in the background: understudy/ in $XDG_STATE_HOME, else in
// ~/.local/state. Throws SetupError if the environment has neither.
std::filesystem::path LogFolder();

// What Detach returns in the child.
class Background {
 public:
  Background(std::filesystem::path log, UniqueFd parent)
      : log_(std::move(log)), parent_(std::move(parent)) {}

  const std::filesystem::path& log() const { return log_; }
  // Tells the parent, which then ends with code 0.
  void Ready();

 private:
  std::filesystem::path log_;
  UniqueFd parent_;
};

// Forks; call it before any thread exists. The child gets a session of its own, no standard input
// and output, and as standard error the file LogFolder()/NAME.log, NAME being name() there. The
// parent waits until the child is ready, and then prints how to reach it, or has ended, and then
// prints what it said; it never returns. A signal that ends the parent before ends the child.
// Throws SetupError, in the child before it has a log, else in the parent.
Background Detach(const std::function<std::string()>& name);

}  // namespace understudy::commands
