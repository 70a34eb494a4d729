// Checks the includes between rooms against docs/dev/architecture.md.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <string>

#include <gtest/gtest.h>

namespace understudy::docs {
namespace {

const std::filesystem::path kRoot = UNDERSTUDY_SOURCE_DIR;

std::string Text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// How far down in the table each room stands.
std::map<std::string, int> Rooms() {
  std::string text = Text(kRoot / "docs/dev/architecture.md");
  text = text.substr(text.find("\n## Rooms\n"));
  text.resize(text.find("\n## ", 1));
  std::map<std::string, int> rooms;
  const std::regex row("\n\\| `([a-z]+)` \\|");
  for (std::sregex_iterator match(text.begin(), text.end(), row), end; match != end; ++match) {
    rooms.emplace((*match)[1], static_cast<int>(rooms.size()));
  }
  return rooms;
}

std::string RoomOf(const std::filesystem::path& path) { return path.begin()->string(); }

TEST(RoomsTest, EachFolderOfSourcesIsInTheTable) {
  const auto rooms = Rooms();
  for (const auto& entry : std::filesystem::directory_iterator(kRoot / "src")) {
    const std::string name = entry.path().filename();
    if (!entry.is_directory() || name == "panel") continue;
    EXPECT_EQ(rooms.count(name), 1u) << name;
  }
}

TEST(RoomsTest, IncludeOnlyWhatStandsBelowThem) {
  const auto rooms = Rooms();
  const std::regex include("#include \"([a-z_]+)/[^\"]+\"");
  int seen = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / "src")) {
    const auto file = std::filesystem::relative(entry.path(), kRoot / "src");
    const std::string extension = file.extension();
    const auto own = rooms.find(RoomOf(file));
    if (own == rooms.end() || (extension != ".h" && extension != ".cc")) continue;
    const std::string text = Text(entry.path());
    for (std::sregex_iterator match(text.begin(), text.end(), include), end; match != end;
         ++match) {
      const auto other = rooms.find((*match)[1]);
      if (other == rooms.end()) continue;  // idl, or a header of its own folder
      EXPECT_GE(other->second, own->second) << file << " includes " << (*match)[0];
      ++seen;
    }
  }
  EXPECT_GT(seen, 500);
}

TEST(RoomsTest, UpToAssemblyIncludeNoThreadSocketOrLog) {
  const auto rooms = Rooms();
  const int assembly = rooms.at("assembly");
  const std::regex unwanted(
      "#include [<\"](thread|sys/socket\\.h|netinet/|boost/asio|boost/beast|spdlog/|dds/)");
  int seen = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / "src")) {
    const auto file = std::filesystem::relative(entry.path(), kRoot / "src");
    const auto own = rooms.find(RoomOf(file));
    if (!entry.is_regular_file() || own == rooms.end()) continue;
    if (own->second < assembly || own->first == "bus") continue;
    if (file == "base/standard_error.cc") continue;  // standard error itself may be a socket
    std::smatch found;
    const std::string text = Text(entry.path());
    EXPECT_FALSE(std::regex_search(text, found, unwanted)) << file << ": " << found[0];
    ++seen;
  }
  EXPECT_GT(seen, 200);
}

}  // namespace
}  // namespace understudy::docs
