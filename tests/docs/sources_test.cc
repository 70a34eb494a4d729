// Checks that cited files exist and that docs/dev/sources.md describes each source.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace understudy::docs {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = UNDERSTUDY_SOURCE_DIR;

std::string Text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// The lines of a file that have that word.
std::string LinesWith(const std::string& word, const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string lines;
  for (std::string line; std::getline(stream, line);) {
    if (line.find(word) != std::string::npos) lines += line + '\n';
  }
  return lines;
}

// The files below these folders that cite.
std::vector<fs::path> Files(const std::vector<std::string>& folders) {
  const std::set<std::string> kinds = {".h", ".cc", ".py", ".yaml", ".md", ".xml", ".json"};
  std::vector<fs::path> files;
  for (const std::string& folder : folders) {
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
      if (entry.is_regular_file() && kinds.contains(entry.path().extension())) {
        files.push_back(entry.path());
      }
    }
  }
  return files;
}

std::vector<std::smatch> Matches(const std::string& text, const std::regex& pattern) {
  return {std::sregex_iterator(text.begin(), text.end(), pattern), {}};
}

// As a link names the headings of a page.
std::set<std::string> Anchors(const std::string& page) {
  std::set<std::string> anchors;
  for (const std::smatch& heading : Matches(page, std::regex("\n#+ ([^\n]*)"))) {
    std::string anchor;
    for (const char c : heading.str(1)) {
      if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-') {
        anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      } else if (c == ' ') {
        anchor += '-';
      }
    }
    anchors.insert(anchor);
  }
  return anchors;
}

// A README is a source's own where ours has no such place.
TEST(SourcesTest, EveryPageThatIsCitedIsHere) {
  const std::regex page("([\\w./-]*\\w\\.md)\\b(#([\\w-]+))?");
  const std::set<std::string> sources = Anchors(Text(kRoot / "docs/dev/sources.md"));
  for (const fs::path& file : Files({"src", "tests", "config", "docs", "models", "examples"})) {
    const std::string text = LinesWith(".md", file);  // to match all of it takes ten times as long
    for (const std::smatch& cited : Matches(text, page)) {
      const fs::path name = fs::path(cited.str(1)).relative_path();
      if (name.filename() == "README.md") continue;
      const std::vector<fs::path> folders = {kRoot, kRoot / "docs", kRoot / "docs/reference",
                                             kRoot / "docs/dev", file.parent_path()};
      EXPECT_TRUE(
          std::ranges::any_of(folders, [&](const fs::path& f) { return fs::exists(f / name); }))
          << file << " cites " << name;
      if (name.filename() == "sources.md" && cited[3].matched) {
        EXPECT_TRUE(sources.contains(cited.str(3))) << file << " cites #" << cited.str(3);
      }
    }
  }
}

TEST(SourcesTest, EverySourceOfAFigureInTheConfigurationIsDescribed) {
  const std::string sources = Text(kRoot / "docs/dev/sources.md");
  for (const fs::path& file : Files({"config/robots", "config/profiles"})) {
    const std::string text = Text(file);
    for (const std::smatch& comment : Matches(text, std::regex("#[^\n]*"))) {
      const std::string said = comment.str();
      for (const std::smatch& word : Matches(said, std::regex("\\[[A-Za-z][A-Za-z_]*[0-9]?\\]"))) {
        EXPECT_NE(sources.find(word.str()), std::string::npos) << file << " cites " << word.str();
        EXPECT_NE(text.find("docs/dev/sources.md"), std::string::npos)
            << file << " does not say where";
      }
    }
  }
}

TEST(SourcesTest, EverySourceOfAServiceIsDescribed) {
  const std::string sources = Text(kRoot / "docs/dev/sources.md"),
                    services = Text(kRoot / "docs/reference/services.md");
  for (const std::smatch& word : Matches(services, std::regex("\\| (\\[[a-z]+\\])"))) {
    EXPECT_NE(sources.find(word.str(1)), std::string::npos) << word.str(1);
  }
}

}  // namespace
}  // namespace understudy::docs
