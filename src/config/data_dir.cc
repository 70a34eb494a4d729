#include "config/data_dir.h"

#include <cstdlib>
#include <system_error>

#include "base/errors.h"

namespace understudy::config {
namespace {

bool Holds(const std::filesystem::path& directory) {
  std::error_code error;
  return std::filesystem::is_directory(directory / "config" / "robots", error);
}

// What the server serves stands beside the program, as installed as in a build.
std::filesystem::path Served(const char* name) {
  const char* variable = std::getenv("UNDERSTUDY_DATA_DIR");
  if (variable != nullptr && *variable != '\0') return std::filesystem::path(variable) / name;
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  return program.parent_path().parent_path() / "share" / "understudy" / name;
}

}  // namespace

std::filesystem::path DataDir() {
  std::error_code error;
  return FindDataDir(std::getenv("UNDERSTUDY_DATA_DIR"),
                     std::filesystem::read_symlink("/proc/self/exe", error), PackageDataDir(),
                     UNDERSTUDY_SOURCE_DIR);
}

std::filesystem::path FindDataDir(const char* variable, const std::filesystem::path& program,
                                  const std::filesystem::path& package,
                                  const std::filesystem::path& source) {
  if (variable != nullptr && *variable != '\0') {
    if (Holds(variable)) return variable;
    throw ConfigError("UNDERSTUDY_DATA_DIR: expected a directory with config/robots, got '" +
                      std::string(variable) + "'");
  }
  if (!package.empty() && Holds(package)) return package;
  std::filesystem::path installed = program.parent_path().parent_path() / "share" / "understudy";
  if (Holds(installed)) return installed;
  if (Holds(source)) return source;
  throw ConfigError("no robot files: neither " + installed.string() + " nor " + source.string() +
                    " holds config/robots; set UNDERSTUDY_DATA_DIR");
}

std::filesystem::path& PackageDataDir() {
  static std::filesystem::path directory;
  return directory;
}

std::filesystem::path PanelDir() { return Served("panel"); }

std::filesystem::path OpenApiFile() { return Served("openapi.yaml"); }

}  // namespace understudy::config
