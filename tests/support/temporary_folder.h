// A temporary folder that exists during a test.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "base/temporary_folder.h"

namespace understudy::test {

class TemporaryFolder : public understudy::TemporaryFolder {
 public:
  TemporaryFolder() : understudy::TemporaryFolder("test") {}

  // Writes a file below the folder, its own folders included, and returns its path.
  std::filesystem::path Write(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = path() / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
    return file;
  }
};

}  // namespace understudy::test
