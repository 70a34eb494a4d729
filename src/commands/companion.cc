#include "commands/companion.h"

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include <CLI/CLI.hpp>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "base/errors.h"

namespace understudy::commands {

namespace {

// The path of a companion, which may not exist.
std::filesystem::path CompanionFile(const std::string& program) {
  std::error_code ignored;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", ignored);
  return self.parent_path().parent_path() / "libexec" / "understudy" / program;
}

}  // namespace

void BecomeCompanion(const Companion& companion, char** argv) {
  const std::filesystem::path file = CompanionFile(companion.program);
  ::execv(file.c_str(), argv);
  const int error = errno;
  const std::string what = "`understudy " + companion.command->get_name() + "` is the program " +
                           file.string() + ": " + std::generic_category().message(error);
  throw SetupError(error == ENOENT ? what + "; " + companion.missing : what);
}

CompanionProcess::CompanionProcess(std::string what, const char* program, const char* missing,
                                   const std::vector<std::string>& words)
    : what_(std::move(what)) {
  const std::filesystem::path file = CompanionFile(program);
  if (!std::filesystem::exists(file)) {
    why_not_ = "there is no " + file.string() + "; " + missing;
    return;
  }
  std::vector<std::string> command{file};
  command.insert(command.end(), words.begin(), words.end());
  try {
    child_.emplace(command);
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
  if (!why_not_.empty()) spdlog::warn("{} cannot be had: {}", what_, why_not_);
}

void CompanionProcess::Watch() {
  if (!child_) return;
  const std::optional<int> code = child_->Poll();
  if (!code) return;
  child_.reset();
  if (*code == 0) {
    spdlog::info("{} was closed; the robot continues", what_);
  } else {
    spdlog::warn("{} ended with code {}; the robot continues without it", what_, *code);
  }
}

}  // namespace understudy::commands
