// Checks the table of kinds of docs/reference/objects.md.
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>

#include "base/printed.h"
#include "objects/object_kinds.h"

namespace understudy::objects {
namespace {

TEST(ObjectsDocTest, HasTheRowOfEachKind) {
  std::ifstream stream(std::filesystem::path(UNDERSTUDY_SOURCE_DIR) / "docs/reference/objects.md");
  const std::string page{std::istreambuf_iterator<char>(stream), {}};
  for (const ObjectKind& kind : ObjectKinds()) {
    std::string source(kind.source);
    source.insert(source.find("assumed"), "*");
    const std::string row = "| `" + std::string(kind.name) + "` | " + std::string(kind.does) +
                            " | " + Printed("%g m", kind.height) + " | " +
                            (kind.fixed() ? "fixed" : Printed("%g kg", kind.mass)) + " | " +
                            Printed("%g", kind.friction) + " | " +
                            (kind.speed > 0 ? Printed("%g m/s", kind.speed) : "") + " | " + source +
                            "* |\n";
    EXPECT_THAT(page, testing::HasSubstr(row));
  }
}

}  // namespace
}  // namespace understudy::objects
