// Checks that the last chapter of docs/fidelity.md lists every figure marked assumed.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <string>

#include <gtest/gtest.h>

namespace understudy::config {
namespace {

const std::filesystem::path kRoot = UNDERSTUDY_SOURCE_DIR;

std::string Text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string EverythingAssumed() {
  const std::string text = Text(kRoot / "docs/fidelity.md");
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

TEST(FidelityDocTest, ListsEveryRobotProfileAndModelWithSomethingAssumed) {
  const std::string listed = EverythingAssumed();
  for (const char* folder : {"config/robots", "config/profiles"}) {
    for (const auto& [file, assumes] : Files(folder)) {
      const std::string name = std::filesystem::path(file).filename();
      EXPECT_TRUE(listed.find("`" + name + "`") != std::string::npos || !assumes) << file;
    }
  }
  const std::string models = listed.substr(listed.find("\n### models"));
  for (const auto& [file, assumes] : Files("models")) {
    const std::string robot = *std::next(std::filesystem::path(file).begin());
    const bool found = models.find("`" + robot + "`") != std::string::npos ||
                       models.find("`" + robot + "/") != std::string::npos;
    EXPECT_TRUE(found || !assumes) << file;
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
