// A temporary directory with configuration files to load.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/load.h"
#include "config/robot_file.h"
#include "schema/yaml_reader.h"
#include "tests/support/error_of.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tiny_robot.h"

namespace understudy::config {

using schema::OneLine;
using schema::ParseYaml;
using schema::ReadYamlFile;
using test::ErrorOf;

class ConfigFixture : public testing::Test {
 protected:
  ConfigFixture() { Write("config/robots/tiny.yaml", test::kTinyRobot); }

  // Returns the path, as --config would be given.
  std::string Write(const std::string& name, const std::string& text) const {
    return folder_.Write(name, text).string();
  }

  Config Load(const std::vector<std::string>& files,
              const std::vector<std::string>& sets = {}) const {
    return LoadConfig({.robot = "tiny", .files = files, .sets = sets}, directory_);
  }
  Config LoadText(const std::string& text) const { return Load({Write("run.yaml", text)}); }

  // The error of a config file with this text, its directory cut off.
  std::string FileError(const std::string& text) const {
    return Relative(ErrorOf([&] { LoadText(text); }));
  }
  std::string SetError(const std::string& set) const {
    return Relative(ErrorOf([&] { Load({}, {set}); }));
  }

  std::string Relative(std::string text) const {
    const std::string prefix = directory_.string() + "/";
    for (std::size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix)) {
      text.erase(at, prefix.size());
    }
    return text;
  }

  const test::TemporaryFolder folder_;
  const std::filesystem::path& directory_ = folder_.path();
};

}  // namespace understudy::config
