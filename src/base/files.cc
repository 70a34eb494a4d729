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

void CheckWritable(const std::filesystem::path& file, bool overwrite) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    throw SetupError(file.string() + " is a folder; name a file in it");
  }
  // A finished file takes the place of what is there, which a device must not lose.
  if (std::filesystem::exists(file, ignored) && !std::filesystem::is_regular_file(file, ignored)) {
    throw SetupError(file.string() + " is not a file");
  }
  if (!overwrite && std::filesystem::exists(file, ignored)) {
    throw RecordError(file.string() +
                      ": exists already; name another file, or replace it with --overwrite");
  }
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  if (!std::filesystem::is_directory(folder, ignored)) {
    throw SetupError("cannot write " + file.string() + ": no folder " + folder.string());
  }
  if (::access(folder.c_str(), W_OK) != 0) {
    throw SetupError("cannot write " + file.string() + ": no right to write in " + folder.string());
  }
}

std::filesystem::path MakeFolder(std::filesystem::path folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw SetupError(folder.string() + ": cannot be made: " + error.message());
  return folder;
}

}  // namespace understudy
