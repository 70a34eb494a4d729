#include "client/control_folder.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <system_error>

#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "base/errors.h"

namespace understudy::client {
namespace {

constexpr std::size_t kLongestName = 64;
constexpr std::size_t kLongestPath = sizeof(sockaddr_un::sun_path) - 1;

// Returns "" if it is unset.
std::string Environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string{} : std::string{value};
}

bool IsOurFolder(const std::filesystem::path& path) {
  struct stat found {};
  return ::stat(path.c_str(), &found) == 0 && S_ISDIR(found.st_mode) && found.st_uid == ::geteuid();
}

std::filesystem::path TransientFolder() { return "/tmp/understudy-" + std::to_string(::geteuid()); }

bool IsNameLetter(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' ||
         c == '_' || c == '-';
}

[[noreturn]] void Refuse(const std::filesystem::path& folder, const std::string& why) {
  throw SocketError("control folder " + folder.string() + ": " + why);
}

}  // namespace

std::filesystem::path ControlFolder() {
  if (const std::string own = Environment("UNDERSTUDY_RUNTIME_DIR"); !own.empty()) {
    return std::filesystem::absolute(own);
  }
  std::error_code ignored;
  if (const std::filesystem::path xdg = Environment("XDG_RUNTIME_DIR");
      xdg.is_absolute() && std::filesystem::is_directory(xdg, ignored)) {
    return xdg / "understudy";
  }
  const std::filesystem::path run = "/run/user/" + std::to_string(::geteuid());
  return IsOurFolder(run) ? run / "understudy" : TransientFolder();
}

bool IsTransient(const std::filesystem::path& folder) { return folder == TransientFolder(); }

void CheckControlFolder(const std::filesystem::path& folder) {
  struct stat found {};
  if (::lstat(folder.c_str(), &found) != 0) Refuse(folder, std::generic_category().message(errno));
  if (!S_ISDIR(found.st_mode)) Refuse(folder, "expected a folder, found something else");
  if (found.st_uid != ::geteuid()) {
    Refuse(folder, "it belongs to user " + std::to_string(found.st_uid) + ", not to " +
                       std::to_string(::geteuid()));
  }
  if ((found.st_mode & (S_IRWXG | S_IRWXO)) != 0) {
    Refuse(folder, "other users may read it; run: chmod 700 " + folder.string());
  }
}

void MakeControlFolder(const std::filesystem::path& folder) {
  if (::mkdir(folder.c_str(), S_IRWXU) != 0 && errno != EEXIST) {
    Refuse(folder, std::generic_category().message(errno));
  }
  CheckControlFolder(folder);
}

std::filesystem::path ControlSocket(const std::string& name) {
  if (name.empty() || name.size() > kLongestName || name.front() == '.' ||
      !std::all_of(name.begin(), name.end(), IsNameLetter)) {
    throw SocketError("robot name \"" + name + "\": expected 1 to " + std::to_string(kLongestName) +
                      " letters, digits, dots, underscores or hyphens, the first not a dot");
  }
  return ControlFolder() / (name + ".sock");
}

std::string DefaultName(const std::string& robot) {
  return robot + "-" + std::to_string(::getpid());
}

void CheckSocketPath(const std::filesystem::path& socket) {
  if (const std::size_t bytes = socket.native().size(); bytes > kLongestPath) {
    throw SocketError("control socket " + socket.string() + ": " + std::to_string(bytes) +
                      " bytes, a socket's path holds " + std::to_string(kLongestPath));
  }
}

}  // namespace understudy::client
