#include "exec/command.h"

#include <array>
#include <cerrno>
#include <fstream>
#include <sstream>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/printed.h"

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

// The interpreter that the first line of a script names; "" of another file.
std::string InterpreterOf(const std::string& path) {
  std::array<char, 256> first{};  // as much as Linux reads
  std::ifstream(path, std::ios::binary).read(first.data(), first.size());
  const std::string_view text(first.data(), first.size());
  const std::size_t begin = text.find_first_not_of(" \t", 2);
  const std::size_t end = text.find_first_of(" \t\n", begin);
  if (!text.starts_with("#!") || end == std::string_view::npos) return "";
  return std::string(text.substr(begin, end - begin));
}

// Before a robot is started for it: exec(2) would refuse it only then.
void RequireInterpreter(const std::string& path) {
  const std::string interpreter = InterpreterOf(path);
  if (interpreter.empty()) return;
  const int error = WhyNotExecutable(interpreter);
  if (error == 0) return;
  throw CommandError("cannot run " + path + ": the interpreter that it asks for, " +
                         Printable(interpreter) + ": " + std::generic_category().message(error),
                     ExitCodeOfFailedExec(error));
}

}  // namespace

int ExitCodeOfFailedExec(int error) { return error == ENOENT ? kExitNotFound : kExitNotExecutable; }

std::string FindProgram(const std::string& name, const std::string& search_path) {
  if (name.find('/') != std::string::npos) {
    if (const int error = WhyNotExecutable(name)) Refuse(name, error);
    RequireInterpreter(name);
    return name;
  }

  std::string not_executable;
  // The added colon keeps a trailing empty folder, as a shell does.
  std::istringstream folders(search_path + ":");
  for (std::string folder; !name.empty() && std::getline(folders, folder, ':');) {
    std::string path = (folder.empty() ? "." : folder) + "/" + name;
    const int error = WhyNotExecutable(path);
    if (error == 0) {
      RequireInterpreter(path);
      return path;
    }
    if (error == EACCES && ::access(path.c_str(), F_OK) == 0 && not_executable.empty()) {
      not_executable = path;
    }
  }
  if (!not_executable.empty()) Refuse(not_executable, EACCES);
  throw CommandError("cannot run `" + name + "`: no such program in PATH", kExitNotFound);
}

}  // namespace understudy::exec
