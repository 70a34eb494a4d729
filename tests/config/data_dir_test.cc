#include "config/data_dir.h"

#include <algorithm>

#include "config_fixture.h"

namespace understudy::config {
namespace {

// The fixture's directory holds config/robots.
class DataDirTest : public ConfigFixture {};

TEST_F(DataDirTest, PrefersTheVariable) {
  EXPECT_EQ(FindDataDir(directory_.c_str(), "/nowhere/bin/understudy", "", UNDERSTUDY_SOURCE_DIR),
            directory_);
}

TEST_F(DataDirTest, RefusesAVariableThatNamesNoDataDirectory) {
  EXPECT_EQ(ErrorOf([&] { FindDataDir("/nowhere", "/nowhere/bin/understudy", "", directory_); }),
            "UNDERSTUDY_DATA_DIR: expected a directory with config/robots, got '/nowhere'");
}

TEST_F(DataDirTest, FindsTheInstalledDirectoryBesideTheProgram) {
  const std::filesystem::path share = directory_ / "share" / "understudy";
  std::filesystem::create_directories(share / "config" / "robots");
  EXPECT_EQ(FindDataDir(nullptr, directory_ / "bin" / "understudy", "", directory_), share);
  EXPECT_EQ(FindDataDir("", directory_ / "bin" / "understudy", "", directory_), share);
}

TEST_F(DataDirTest, FindsThatOfThePackageWithWhichAProgramWasBuilt) {
  EXPECT_EQ(FindDataDir(nullptr, "/home/user/bin/mine", directory_, "/nowhere"), directory_);
}

TEST_F(DataDirTest, FallsBackToTheSourceTree) {
  EXPECT_EQ(FindDataDir(nullptr, "/nowhere/bin/understudy", "", directory_), directory_);
}

TEST_F(DataDirTest, RefusesWhenThereIsNone) {
  EXPECT_EQ(ErrorOf([] { FindDataDir(nullptr, "/a/bin/understudy", "", "/b"); }),
            "no robot files: neither /a/share/understudy nor /b holds config/robots; set "
            "UNDERSTUDY_DATA_DIR");
}

TEST_F(DataDirTest, HoldsOurRobotsInTheSourceTree) {
  const std::vector<std::string> names = RobotNames(DataDir());
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  EXPECT_THAT(names, testing::IsSupersetOf({"g1", "go2", "h1", "h1_2", "h2", "r1"}));
}

}  // namespace
}  // namespace understudy::config
