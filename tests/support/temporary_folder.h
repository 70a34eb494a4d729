// A temporary folder that exists during a test.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "base/temporary_folder.h"

namespace understudy::test {

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::filesystem::create_directory(path_);
    std::filesystem::permissions(path_, std::filesystem::perms::owner_all);
    // So that a test may let other users into the folder itself.
    std::filesystem::permissions(held_.path(), std::filesystem::perms(0755));
  }

  const std::filesystem::path& path() const { return path_; }

  // Writes a file below the folder, its own folders included, and returns its path.
  std::filesystem::path Write(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = path() / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
    return file;
  }

 private:
  understudy::TemporaryFolder held_{"test"};
  // Below the one that is locked, for control folders have locks of their own.
  std::filesystem::path path_ = held_.path() / "t";
};

}  // namespace understudy::test
