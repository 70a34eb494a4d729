#include "client/listening_socket.h"

#include <fstream>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/errors.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/support/control.h"

namespace understudy::client {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class ListeningSocketTest : public ::testing::Test {
 protected:
  test::TemporaryFolder temp_;
  const std::filesystem::path path_ = temp_.path() / "g1.sock";
};

TEST_F(ListeningSocketTest, OnlyItsUserMayOpenIt) {
  const ListeningSocket dut(path_);
  struct stat found {};
  ASSERT_EQ(::lstat(path_.c_str(), &found), 0);
  EXPECT_TRUE(S_ISSOCK(found.st_mode));
  EXPECT_EQ(found.st_mode & 07777, 0600u);
}

TEST_F(ListeningSocketTest, IsAliveWhileItExistsAndTellsItsProcess) {
  {
    const ListeningSocket dut(path_);
    const SocketProbe probe = ProbeSocket(path_);
    EXPECT_EQ(probe.state, SocketState::kAlive);
    EXPECT_EQ(probe.pid, ::getpid());
  }
  EXPECT_EQ(ProbeSocket(path_).state, SocketState::kAbsent);
}

TEST_F(ListeningSocketTest, DoesNotPassItsDescriptorOnToPrograms) {
  const ListeningSocket dut(path_);
  EXPECT_NE(::fcntl(dut.fd(), F_GETFD) & FD_CLOEXEC, 0);
}

TEST_F(ListeningSocketTest, ANameInUseIsAnErrorThatNamesTheProcess) {
  const ListeningSocket first(path_);
  EXPECT_THAT(
      [&] { ListeningSocket second(path_); },
      ThrowsMessage<SocketError>(AllOf(HasSubstr("in use by process " + std::to_string(::getpid())),
                                       HasSubstr("another --name"), HasSubstr(path_.string()))));
  EXPECT_EQ(ProbeSocket(path_).state, SocketState::kAlive);
}

TEST_F(ListeningSocketTest, ReplacesTheSocketOfADeadProcess) {
  test::LeaveStaleSocket(path_);
  ASSERT_EQ(ProbeSocket(path_).state, SocketState::kStale);
  const ListeningSocket dut(path_);
  EXPECT_EQ(ProbeSocket(path_).state, SocketState::kAlive);
}

TEST_F(ListeningSocketTest, LeavesAFileAlone) {
  std::ofstream(path_) << "precious";
  EXPECT_THAT([&] { ListeningSocket dut(path_); },
              ThrowsMessage<ControlError>(HasSubstr("left alone")));
  EXPECT_TRUE(std::filesystem::is_regular_file(path_));
}

TEST_F(ListeningSocketTest, NamesTheFolderThatIsNotThere) {
  EXPECT_THAT([&] { ListeningSocket dut(temp_.path() / "no" / "g1.sock"); },
              ThrowsMessage<ControlError>(HasSubstr("No such file")));
}

TEST_F(ListeningSocketTest, RefusesAPathTooLong) {
  EXPECT_THAT([&] { ListeningSocket dut(temp_.path() / std::string(120, 'x')); },
              ThrowsMessage<ControlError>(HasSubstr("107")));
}

TEST_F(ListeningSocketTest, DoesNotRemoveWhatAnotherPutInItsPlace) {
  {
    const ListeningSocket dut(path_);
    std::filesystem::rename(path_, temp_.path() / "away.sock");  // keeps its inode from reuse
    std::ofstream(path_) << "another's";
  }
  EXPECT_TRUE(std::filesystem::exists(path_));
}

TEST_F(ListeningSocketTest, RemovesTheStaleAndNothingElse) {
  const std::filesystem::path stale = temp_.path() / "stale.sock";
  const std::filesystem::path file = temp_.path() / "file.sock";
  const ListeningSocket alive(path_);
  test::LeaveStaleSocket(stale);
  std::ofstream(file) << "precious";
  for (const auto& path : {path_, stale, file}) RemoveIfStale(path);
  EXPECT_TRUE(std::filesystem::exists(path_));
  EXPECT_FALSE(std::filesystem::exists(stale));
  EXPECT_TRUE(std::filesystem::exists(file));
}

TEST_F(ListeningSocketTest, DoesNotTakeASocketBetweenBindAndListenForStale) {
  const test::RawSocket young;
  ASSERT_TRUE(young.Bind(path_));
  const int folder = ::open(temp_.path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  ASSERT_EQ(::flock(folder, LOCK_EX), 0);  // as its process does until it listens
  RemoveIfStale(path_);
  EXPECT_TRUE(std::filesystem::exists(path_));
  ::close(folder);
}

}  // namespace
}  // namespace understudy::client
