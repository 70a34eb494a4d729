#include "commands/panel_memory.h"

#include <array>
#include <cstdlib>
#include <sstream>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/unique_fd.h"

namespace understudy::commands {
namespace {

constexpr std::size_t kTokenDigits = 32;  // as server::RandomToken has

}  // namespace

std::filesystem::path StateFolder() {
  const auto folder = [](const char* variable) -> std::filesystem::path {
    const char* const value = std::getenv(variable);
    return value != nullptr && *value == '/' ? value : "";
  };
  if (const auto state = folder("XDG_STATE_HOME"); !state.empty()) return state / "understudy";
  if (const auto home = folder("HOME"); !home.empty()) return home / ".local/state/understudy";
  return {};
}

std::filesystem::path PanelMemoryFile(const std::string& name) {
  const std::filesystem::path folder = StateFolder();
  const bool plain = !name.empty() && name.find('/') == std::string::npos;
  return folder.empty() || !plain ? std::filesystem::path() : folder / (name + ".panel");
}

server::PanelPlace RecallPanel(const std::filesystem::path& file) {
  if (file.empty()) return {};
  const UniqueFd fd(::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat found {};
  if (fd.get() < 0 || ::fstat(fd.get(), &found) != 0) return {};
  if (!S_ISREG(found.st_mode) || found.st_uid != ::geteuid() || (found.st_mode & 077U) != 0) {
    return {};
  }
  std::array<char, 64> bytes{};
  const ssize_t size = ::read(fd.get(), bytes.data(), bytes.size());
  if (size <= 0) return {};
  std::istringstream text(std::string(bytes.data(), static_cast<std::size_t>(size)));
  server::PanelPlace place;
  if (!(text >> place.port >> place.token) || place.port < 1024 || place.port > 65535 ||
      place.token.size() != kTokenDigits ||
      place.token.find_first_not_of("0123456789abcdef") != std::string::npos) {
    return {};
  }
  return place;
}

void RememberPanel(const std::filesystem::path& file, const server::PanelPlace& place) {
  if (file.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  std::string name = file.string() + ".XXXXXX";
  const UniqueFd fd(::mkostemp(name.data(), O_CLOEXEC));  // mode 0600
  if (fd.get() < 0) return;
  const std::string text = std::to_string(place.port) + " " + place.token + "\n";
  const bool written =
      ::write(fd.get(), text.data(), text.size()) == static_cast<ssize_t>(text.size());
  if (!written || ::rename(name.c_str(), file.c_str()) != 0) ::unlink(name.c_str());
}

}  // namespace understudy::commands
