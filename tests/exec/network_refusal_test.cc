// Tests what is said where a private network is refused: by the kernel, or for a second thread.
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

#include "exec/private_network.h"
#include "forked.h"
#include "network_fixture.h"

namespace understudy::exec {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::understudy::test::InFork;
using ::understudy::test::Pipe;
using ::understudy::test::ReadLine;

// As a container's system call filter does it, root or not.
void Forbid(std::uint32_t call, std::uint32_t error) {
  sock_filter rules[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, call, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | error),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  const sock_fprog program{.len = 4, .filter = rules};
  Check(::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0, "no_new_privs");
  Check(::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0, "seccomp");
}

void ForbidUnshare() { Forbid(SYS_unshare, EPERM); }

TEST(PrivateNetworkRefusalTest, SpeaksOfTheContainerUnderASystemCallFilter) {
  EXPECT_THAT(InFork([] {
                ForbidUnshare();
                EnterPrivateNetwork();
                return std::string("entered");
              }),
              AllOf(HasSubstr("Operation not permitted"), HasSubstr("docker run --cap-add"),
                    HasSubstr("--network host")));
}

TEST(PrivateNetworkRefusalTest, SpeaksOfTheContainerForACableToo) {
  EXPECT_THAT(InFork([] {
                ForbidUnshare();
                const CabledNetwork network({.interface = "eth0", .address = "192.168.123.99"});
                return std::string("entered");
              }),
              AllOf(HasSubstr("Operation not permitted"), HasSubstr("docker run --cap-add")));
}

TEST(PrivateNetworkRefusalTest, SaysWhatToDoWhereTheKernelMakesNoCable) {
  EXPECT_THAT(InFork([] {
                Forbid(SYS_sendto, EOPNOTSUPP);  // what is sent to rtnetlink
                const CabledNetwork network({.interface = "eth0", .address = "192.168.123.99"});
                return std::string("entered");
              }),
              AllOf(HasSubstr("making a veth pair failed: Operation not supported"),
                    HasSubstr("modprobe veth"), HasSubstr("leave --interface-name out")));
}

TEST(PrivateNetworkRefusalTest, PassesOnWhatTheKernelSaysOfACable) {
  EXPECT_THAT(InFork([] {
                const CabledNetwork network({.interface = "lo", .address = "192.168.123.99"});
                return std::string("entered");
              }),
              HasSubstr("making a veth pair failed: File exists"));
}

TEST(PrivateNetworkRefusalTest, RefusesASecondThread) {
  EXPECT_THAT(InFork([] {
                Pipe pipe;
                std::thread other([&] { ReadLine(pipe.out.get()); });
                std::string result = "entered";
                try {
                  EnterPrivateNetwork();
                } catch (const std::exception& error) {
                  result = error.what();
                }
                pipe.in.reset();
                other.join();
                return result;
              }),
              HasSubstr("already runs"));
}

}  // namespace
}  // namespace understudy::exec
