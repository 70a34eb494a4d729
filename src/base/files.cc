#include "base/files.h"

#include <fstream>
#include <sstream>
#include <system_error>

#include <unistd.h>

#include "base/errors.h"

namespace understudy {

std::string FileText(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

void WriteFile(const std::filesystem::path& file, const std::string& text) {
  // Beside it, as a rename stays within a file system; by process, as shards may share a folder.
  const std::filesystem::path part = file.string() + ".part" + std::to_string(::getpid());
  std::ofstream stream(part, std::ios::binary | std::ios::trunc);
  stream << text;
  stream.close();
  std::error_code error;
  if (stream) std::filesystem::rename(part, file, error);
  if (!stream || error) {
    std::filesystem::remove(part, error);
    throw SetupError(file.string() + ": cannot be written");
  }
}

std::filesystem::path MakeFolder(std::filesystem::path folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw SetupError(folder.string() + ": cannot be made: " + error.message());
  return folder;
}

}  // namespace understudy
