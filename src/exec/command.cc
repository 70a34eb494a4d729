#include "exec/command.h"

#include <cerrno>
#include <sstream>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace understudy::exec {
namespace {

// Returns 0 or the errno that exec(2) would set.
int WhyNotExecutable(const std::string& path) {
  struct stat file {};
  if (::stat(path.c_str(), &file) != 0) return errno;
  if (!S_ISREG(file.st_mode)) return EACCES;
  return ::faccessat(AT_FDCWD, path.c_str(), X_OK, AT_EACCESS) == 0 ? 0 : errno;
}

[[noreturn]] void Refuse(const std::string& path, int error) {
  throw CommandError("cannot run " + path + ": " + std::generic_category().message(error),
                     ExitCodeOfFailedExec(error));
}

}  // namespace

int ExitCodeOfFailedExec(int error) { return error == ENOENT ? kExitNotFound : kExitNotExecutable; }

std::string FindProgram(const std::string& name, const std::string& search_path) {
  if (name.find('/') != std::string::npos) {
    if (const int error = WhyNotExecutable(name)) Refuse(name, error);
    return name;
  }

  std::string not_executable;
  // The added colon keeps a trailing empty folder, as a shell does.
  std::istringstream folders(search_path + ":");
  for (std::string folder; !name.empty() && std::getline(folders, folder, ':');) {
    std::string path = (folder.empty() ? "." : folder) + "/" + name;
    const int error = WhyNotExecutable(path);
    if (error == 0) return path;
    if (error == EACCES && ::access(path.c_str(), F_OK) == 0 && not_executable.empty()) {
      not_executable = path;
    }
  }
  if (!not_executable.empty()) Refuse(not_executable, EACCES);
  throw CommandError("cannot run `" + name + "`: no such program in PATH", kExitNotFound);
}

}  // namespace understudy::exec
