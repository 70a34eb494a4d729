#include "commands/companion.h"

#include <array>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include <CLI/CLI.hpp>
#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "base/errors.h"
#include "exec/companion_file.h"

namespace understudy::commands {

void BecomeCompanion(const Companion& companion, char** argv) {
  const std::filesystem::path file = exec::CompanionFile(companion.program);
  ::execv(file.c_str(), argv);
  const int error = errno;
  const std::string what = "`understudy " + companion.command->get_name() + "` is the program " +
                           file.string() + ": " + std::generic_category().message(error);
  throw SetupError(error == ENOENT ? what + "; " + companion.missing : what);
}

CompanionProcess::CompanionProcess(std::string what, const char* program, const char* missing,
                                   const std::vector<std::string>& words)
    : what_(std::move(what)) {
  const std::filesystem::path file = exec::CompanionFile(program);
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) {
    why_not_ = "there is no " + file.string() + "; " + missing;
    return;
  }
  std::vector<std::string> command{file};
  command.insert(command.end(), words.begin(), words.end());
  std::array<int, 2> ends{-1, -1};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    why_not_ = std::generic_category().message(errno);
    return;
  }
  said_ = UniqueFd(ends[0]);
  const UniqueFd says(ends[1]);
  ::fcntl(said_.get(), F_SETFL, O_NONBLOCK);
  try {
    child_.emplace(command, exec::ChildProcess::Environment{}, says.get());
  } catch (const exec::CommandError& error) {
    why_not_ = error.what();
  }
}

void CompanionProcess::Release() {
  if (child_) {
    try {
      child_->Release();
    } catch (const exec::CommandError& error) {
      why_not_ = error.what();
      child_.reset();
    }
  }
  if (!why_not_.empty()) spdlog::warn("{} cannot be opened: {}", what_, why_not_);
}

void CompanionProcess::Watch() {
  if (!child_) return;
  LogLines();
  const std::optional<int> code = child_->Poll();
  if (!code) return;
  LogLines();
  child_.reset();
  if (*code == 0) {
    spdlog::info("{} was closed; the robot continues", what_);
  } else {
    spdlog::warn("{} ended with code {}; the robot continues without it", what_, *code);
  }
}

// At most a page of them, as the tick waits meanwhile; the companion waits for the rest to be read.
void CompanionProcess::LogLines() {
  std::array<char, 4096> bytes;
  const ssize_t got = ::read(said_.get(), bytes.data(), bytes.size());
  if (got <= 0) return;
  unsaid_.append(bytes.data(), static_cast<std::size_t>(got));
  std::size_t begin = 0;
  for (std::size_t end; (end = unsaid_.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const std::string line = unsaid_.substr(begin, end - begin);
    // What ends it, as CatchErrors says it, is worth a warning.
    const bool error = line.starts_with("understudy: ");
    if (!line.empty())
      spdlog::log(error ? spdlog::level::warn : spdlog::level::info, "{}: {}", what_, line);
  }
  unsaid_.erase(0, begin);
  if (unsaid_.size() > bytes.size()) unsaid_.clear();  // no line of ours is that long
}

}  // namespace understudy::commands
