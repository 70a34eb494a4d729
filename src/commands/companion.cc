#include "commands/companion.h"

#include <cerrno>
#include <system_error>

#include <CLI/CLI.hpp>
#include <unistd.h>

#include "base/errors.h"

namespace understudy::commands {

std::filesystem::path CompanionFile(const std::string& program) {
  std::error_code ignored;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", ignored);
  return self.parent_path().parent_path() / "libexec" / "understudy" / program;
}

void BecomeCompanion(const Companion& companion, char** argv) {
  const std::filesystem::path file = CompanionFile(companion.program);
  ::execv(file.c_str(), argv);
  const int error = errno;
  const std::string what = "`understudy " + companion.command->get_name() + "` is the program " +
                           file.string() + ": " + std::generic_category().message(error);
  throw SetupError(error == ENOENT ? what + "; " + companion.missing : what);
}

}  // namespace understudy::commands
