#include "client/control_folder.h"

#include <sys/stat.h>
#include <unistd.h>

#include "base/errors.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/support/control.h"

namespace understudy::client {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

mode_t ModeOf(const std::filesystem::path& path) {
  struct stat found {};
  return ::lstat(path.c_str(), &found) == 0 ? found.st_mode & 07777 : 0;
}

class ControlFolderTest : public ::testing::Test {
 protected:
  test::TemporaryFolder temp_;
  test::ScopedEnv own_{"UNDERSTUDY_RUNTIME_DIR", std::nullopt};
  test::ScopedEnv xdg_{"XDG_RUNTIME_DIR", std::nullopt};
};

TEST_F(ControlFolderTest, OurOwnVariableComesFirst) {
  const test::ScopedEnv own("UNDERSTUDY_RUNTIME_DIR", "/somewhere/else");
  const test::ScopedEnv xdg("XDG_RUNTIME_DIR", temp_.path().string());
  EXPECT_EQ(ControlFolder(), "/somewhere/else");
}

TEST_F(ControlFolderTest, ThenTheSessionsFolder) {
  const test::ScopedEnv xdg("XDG_RUNTIME_DIR", temp_.path().string());
  EXPECT_EQ(ControlFolder(), temp_.path() / "understudy");
}

TEST_F(ControlFolderTest, ASessionsFolderThatIsNotThereIsPassedOver) {
  const std::filesystem::path missing = temp_.path() / "missing";
  const test::ScopedEnv xdg("XDG_RUNTIME_DIR", missing.string());
  EXPECT_NE(ControlFolder(), missing / "understudy");
}

TEST_F(ControlFolderTest, WithoutVariablesItIsTheUsersOwn) {
  const std::string uid = std::to_string(::geteuid());
  EXPECT_THAT(ControlFolder().string(),
              ::testing::AnyOf("/run/user/" + uid + "/understudy", "/tmp/understudy-" + uid));
}

TEST_F(ControlFolderTest, IsCreatedForItsUserAlone) {
  const std::filesystem::path folder = temp_.path() / "new";
  MakeControlFolder(folder);
  EXPECT_EQ(ModeOf(folder), 0700u);
  MakeControlFolder(folder);  // and may be there already
}

TEST_F(ControlFolderTest, RefusesAFolderThatOthersMayLookInto) {
  ::chmod(temp_.path().c_str(), 0755);
  EXPECT_THAT([&] { MakeControlFolder(temp_.path()); },
              ThrowsMessage<ControlError>(HasSubstr("chmod 700")));
}

TEST_F(ControlFolderTest, RefusesALink) {
  const std::filesystem::path link = temp_.path() / "link";
  std::filesystem::create_directory_symlink(temp_.path(), link);
  EXPECT_THAT([&] { MakeControlFolder(link); },
              ThrowsMessage<ControlError>(HasSubstr("expected a folder")));
}

TEST_F(ControlFolderTest, RefusesAFolderOfAnotherUser) {
  // Root may give a folder away; anybody else finds one of root's.
  std::filesystem::path folder = "/proc/1";
  if (::geteuid() == 0) {
    folder = temp_.path() / "given";
    std::filesystem::create_directory(folder);
    ASSERT_EQ(::chown(folder.c_str(), 65534, 65534), 0);
  }
  EXPECT_THAT([&] { CheckControlFolder(folder); },
              ThrowsMessage<ControlError>(HasSubstr("belongs to user")));
}

TEST_F(ControlFolderTest, NamesTheFolderThatCannotBeMade) {
  EXPECT_THAT([&] { MakeControlFolder(temp_.path() / "no" / "such"); },
              ThrowsMessage<ControlError>(HasSubstr("No such file")));
}

TEST_F(ControlFolderTest, ASocketHasTheRobotsName) {
  const test::ScopedEnv own("UNDERSTUDY_RUNTIME_DIR", temp_.path().string());
  EXPECT_EQ(ControlSocket("left.g1_2-b"), temp_.path() / "left.g1_2-b.sock");
  EXPECT_EQ(DefaultName("go2"), "go2-" + std::to_string(::getpid()));
}

TEST_F(ControlFolderTest, RefusesANameThatLeadsElsewhere) {
  EXPECT_THROW(ControlSocket("../g1"), ControlError);
}

TEST_F(ControlFolderTest, RefusesAHiddenName) { EXPECT_THROW(ControlSocket(".g1"), ControlError); }

TEST_F(ControlFolderTest, RefusesAnEmptyName) { EXPECT_THROW(ControlSocket(""), ControlError); }

TEST_F(ControlFolderTest, RefusesANameTooLong) {
  EXPECT_NO_THROW(ControlSocket(std::string(64, 'a')));
  EXPECT_THROW(ControlSocket(std::string(65, 'a')), ControlError);
}

TEST_F(ControlFolderTest, RefusesAPathTooLongForASocket) {
  EXPECT_NO_THROW(CheckSocketPath(std::string(107, 'a')));
  EXPECT_THAT([] { CheckSocketPath(std::string(108, 'a')); },
              ThrowsMessage<ControlError>(HasSubstr("108 bytes, a socket's path holds 107")));
}

}  // namespace
}  // namespace understudy::client
