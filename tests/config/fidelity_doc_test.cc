// Checks that every figure marked assumed is listed: by the last chapter of
// docs/reference/fidelity.md, or, of a robot, by the README beside its model.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/robots.h"

namespace understudy::config {
namespace {

const std::filesystem::path kRoot = UNDERSTUDY_SOURCE_DIR;

std::string Text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string EverythingAssumed() {
  const std::string text = Text(kRoot / "docs/reference/fidelity.md");
  return text.substr(text.find("\n## Everything assumed"));
}

// Whether each file below a folder says that something in it is assumed, by path from the root.
std::map<std::string, bool> Files(const std::string& folder) {
  std::map<std::string, bool> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / folder)) {
    if (!entry.is_regular_file()) continue;
    std::string text = Text(entry.path());
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
    files[std::filesystem::relative(entry.path(), kRoot)] =
        text.find("assumed") != std::string::npos;
  }
  return files;
}

TEST(FidelityDocTest, ListsEveryFileOfTheCodeWithSomethingAssumed) {
  const std::string listed = EverythingAssumed();
  for (const auto& [file, assumes] : Files("src")) {
    const std::filesystem::path path(file);
    bool found = false;  // by its name, its path or its folder
    for (const std::string& place :
         {path.filename().string(), file, path.parent_path().string() + "/"}) {
      found = found || listed.find("`" + place + "`") != std::string::npos;
    }
    EXPECT_TRUE(found || !assumes) << file;
  }
}

TEST(FidelityDocTest, ListsEveryProfileWithSomethingAssumed) {
  const std::string listed = EverythingAssumed();
  for (const auto& [file, assumes] : Files("config/profiles")) {
    const std::string name = std::filesystem::path(file).filename();
    EXPECT_TRUE(listed.find("`" + name + "`") != std::string::npos || !assumes) << file;
  }
}

TEST(ReadmeOfAModelTest, ListsTheRobotsOfTheModelWithSomethingAssumed) {
  const std::map<std::string, bool> files = Files("config/robots");
  for (const std::string& robot : test::Robots()) {
    const std::filesystem::path model = "models/" + test::ShippedRobot(robot).model;
    const std::string readme = Text(kRoot / model.parent_path() / "README.md");
    const std::size_t listed = readme.find("\n## Assumed of the robot\n");
    const bool found = listed != std::string::npos &&
                       readme.find("[`" + robot + ".yaml`]", listed) != std::string::npos;
    EXPECT_TRUE(found || !files.at("config/robots/" + robot + ".yaml"))
        << model.parent_path() << ": README.md does not list what is assumed of " << robot;
  }
}

TEST(ReadmeOfAModelTest, SaysWhatOfTheModelIsAssumed) {
  const std::map<std::string, bool> files = Files("models");
  for (const auto& [file, assumes] : files) {
    const std::filesystem::path path(file);
    const std::string folder = *std::next(path.begin());
    const auto readme = files.find("models/" + folder + "/README.md");
    EXPECT_TRUE(!assumes || (readme != files.end() && readme->second)) << file;
  }
}

TEST(FidelityDocTest, ListsNoFileOfTheCodeThatSaysNothingOfIt) {
  const std::string listed = EverythingAssumed();
  const std::map<std::string, bool> files = Files("src");
  const std::regex place("`([a-z0-9_/]+\\.(?:h|cc))`");
  for (std::sregex_iterator it(listed.begin(), listed.end(), place), end; it != end; ++it) {
    const std::string name = (*it)[1];
    const bool assumes = std::ranges::any_of(files, [&](const auto& file) {
      return file.second && (file.first == name || file.first.ends_with("/" + name));
    });
    EXPECT_TRUE(assumes) << name;
  }
}

}  // namespace
}  // namespace understudy::config
