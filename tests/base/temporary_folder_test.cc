#include "base/temporary_folder.h"

#include <chrono>
#include <csignal>
#include <fstream>
#include <optional>
#include <string>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/errors.h"
#include "base/signals.h"

namespace understudy {
namespace {

namespace fs = std::filesystem;

// Puts files and folders into the folder, more than one read of a folder lists.
void Fill(const fs::path& folder) {
  fs::create_directories(folder / "a/b/c");
  for (int i = 0; i < 300; ++i) {
    std::ofstream(folder / ("file" + std::to_string(i))) << "x";
    std::ofstream(folder / "a/b" / ("file" + std::to_string(i))) << "x";
  }
  fs::create_symlink("/", folder / "root");
}

TEST(TemporaryFolderTest, IsThereWithItsPurposeInItsNameUntilItGoesWithAllInIt) {
  fs::path path;
  {
    const TemporaryFolder folder("scene");
    path = folder.path();
    EXPECT_TRUE(fs::is_directory(path));
    EXPECT_EQ(path.filename().string().find("understudy-scene-"), 0U);
    Fill(path);
  }
  EXPECT_FALSE(fs::exists(path));
  EXPECT_TRUE(fs::exists("/etc"));
}

TEST(TemporaryFolderTest, CanBeMadeAgainAndAgain) {
  for (int i = 0; i < 100; ++i) TemporaryFolder folder("again");
}

TEST(TemporaryFolderTest, SaysWhereNoneCanBeMade) {
  const char* before = std::getenv("TMPDIR");
  const std::optional<std::string> was =
      before == nullptr ? std::nullopt : std::optional<std::string>(before);
  ::setenv("TMPDIR", "/proc", 1);
  EXPECT_THROW(TemporaryFolder("scene"), SetupError);
  was ? ::setenv("TMPDIR", was->c_str(), 1) : ::unsetenv("TMPDIR");
}

// A child that makes a folder, tells its name and waits for `signals`; gives the name and how it
// ended.
std::pair<fs::path, int> EndBySignal(int signal, bool stops_first) {
  int ends[2];
  EXPECT_EQ(::pipe(ends), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(signal, SIG_DFL);
    if (stops_first) CatchStopSignals();
    const TemporaryFolder folder("signal");
    Fill(folder.path());
    const std::string name = folder.path();
    if (::write(ends[1], name.c_str(), name.size() + 1) < 0) ::_exit(1);
    for (;;) ::pause();
  }
  char name[4096] = "";
  EXPECT_GT(::read(ends[0], name, sizeof name), 0);
  if (stops_first) {
    ::kill(child, signal);
    ::usleep(50'000);  // the second is one only after the first was handled
  }
  ::kill(child, signal);
  int status = 0;
  ::waitpid(child, &status, 0);
  ::close(ends[0]);
  ::close(ends[1]);
  return {name, status};
}

TEST(TemporaryFolderTest, GoesWhenASignalEndsTheProcess) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const auto [path, status] = EndBySignal(signal, false);
    EXPECT_FALSE(path.empty());
    EXPECT_FALSE(fs::exists(path)) << path;
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal);
  }
}

TEST(TemporaryFolderTest, GoesWhenASecondSignalEndsAProcessThatTookTheFirst) {
  const auto [path, status] = EndBySignal(SIGTERM, true);
  EXPECT_FALSE(fs::exists(path)) << path;
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM);
}

// As if it had been made `seconds` ago.
void Age(const fs::path& folder, int seconds) {
  fs::last_write_time(folder, fs::file_time_type::clock::now() - std::chrono::seconds(seconds));
}

TEST(TemporaryFolderTest, RemovesWhatAKilledProcessLeftOfItsPurpose) {
  const auto [left, status] = EndBySignal(SIGKILL, false);
  ASSERT_TRUE(fs::exists(left));
  Age(left, 100);
  { const TemporaryFolder other("scene"); }
  EXPECT_TRUE(fs::exists(left));
  { const TemporaryFolder folder("signal"); }
  EXPECT_FALSE(fs::exists(left));
}

TEST(TemporaryFolderTest, LeavesAFolderThatIsTooYoungToBeLockedYet) {
  const auto [left, status] = EndBySignal(SIGKILL, false);
  Age(left, 10);
  { const TemporaryFolder folder("signal"); }
  EXPECT_TRUE(fs::exists(left));
  fs::remove_all(left);
}

TEST(TemporaryFolderTest, LeavesFoldersThatAProcessHolds) {
  const TemporaryFolder held("held");
  Age(held.path(), 100);
  { const TemporaryFolder folder("held"); }
  EXPECT_TRUE(fs::exists(held.path()));
}

TEST(TemporaryFolderTest, LeavesLinksAndLongerNamesOfItsPurpose) {
  const fs::path parent = fs::temp_directory_path();
  const TemporaryFolder target("target");
  Age(target.path(), 100);
  const fs::path link = parent / "understudy-stray-123456";
  const fs::path longer = parent / "understudy-stray-1234567";
  fs::create_directory_symlink(target.path(), link);
  fs::create_directory(longer);
  Age(longer, 100);
  { const TemporaryFolder folder("stray"); }
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_TRUE(fs::exists(longer));
  EXPECT_TRUE(fs::exists(target.path()));
  fs::remove(link);
  fs::remove(longer);
}

}  // namespace
}  // namespace understudy
