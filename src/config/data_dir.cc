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

// A file that the server serves; its place in the source tree differs.
std::filesystem::path Served(const char* name, const char* source) {
  const char* variable = std::getenv("UNDERSTUDY_DATA_DIR");
  if (variable != nullptr && *variable != '\0') return std::filesystem::path(variable) / name;
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  std::filesystem::path installed =
      program.parent_path().parent_path() / "share" / "understudy" / name;
  if (std::filesystem::exists(installed, error)) return installed;
  return std::filesystem::path(UNDERSTUDY_SOURCE_DIR) / source;
}

}  // namespace

std::filesystem::path DataDir() {
  std::error_code error;
  return FindDataDir(std::getenv("UNDERSTUDY_DATA_DIR"),
                     std::filesystem::read_symlink("/proc/self/exe", error), UNDERSTUDY_SOURCE_DIR);
}

std::filesystem::path FindDataDir(const char* variable, const std::filesystem::path& program,
                                  const std::filesystem::path& source) {
  if (variable != nullptr && *variable != '\0') {
    if (Holds(variable)) return variable;
    throw ConfigError("UNDERSTUDY_DATA_DIR: expected a directory with config/robots, got '" +
                      std::string(variable) + "'");
  }
  std::filesystem::path installed = program.parent_path().parent_path() / "share" / "understudy";
  if (Holds(installed)) return installed;
  if (Holds(source)) return source;
  throw ConfigError("no robot files: neither " + installed.string() + " nor " + source.string() +
                    " holds config/robots; set UNDERSTUDY_DATA_DIR");
}

std::filesystem::path PanelDir() { return Served("panel", "src/panel/web"); }

std::filesystem::path OpenApiFile() { return Served("openapi.yaml", "docs/openapi.yaml"); }

}  // namespace understudy::config
