#include "exec/namespace_refusal.h"

#include <cerrno>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace understudy::exec {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(NamespaceRefusalTest, NamesTheStepTheReasonAndTheWayAround) {
  EXPECT_THAT(ExplainRefusal("raising lo", EPERM, {}),
              AllOf(HasSubstr("raising lo failed: Operation not permitted"),
                    HasSubstr("--network host"), Not(HasSubstr("\n"))));
}

TEST(NamespaceRefusalTest, NamesTheSwitchedOffUserNamespaces) {
  EXPECT_THAT(ExplainRefusal("unshare", ENOSPC, {.max_user_namespaces = 0}),
              HasSubstr("sudo sysctl user.max_user_namespaces="));
}

TEST(NamespaceRefusalTest, NamesTheSwitchedOffNetworkNamespaces) {
  EXPECT_THAT(
      ExplainRefusal("unshare", ENOSPC, {.max_user_namespaces = 100, .max_net_namespaces = 0}),
      HasSubstr("sudo sysctl user.max_net_namespaces="));
}

TEST(NamespaceRefusalTest, TellsTakenNamespacesFromSwitchedOffOnes) {
  EXPECT_THAT(
      ExplainRefusal("unshare", ENOSPC, {.max_user_namespaces = 100, .max_net_namespaces = 100}),
      AllOf(HasSubstr("are taken"), Not(HasSubstr("sudo"))));
}

TEST(NamespaceRefusalTest, NamesAppArmorsRestriction) {
  EXPECT_THAT(ExplainRefusal("unshare", EACCES, {.apparmor_restricts = 1}),
              HasSubstr("sudo sysctl kernel.apparmor_restrict_unprivileged_userns=0"));
}

TEST(NamespaceRefusalTest, NamesTheSwitchOfOlderDebians) {
  EXPECT_THAT(ExplainRefusal("unshare", EPERM, {.unprivileged_clone = 0}),
              HasSubstr("sudo sysctl kernel.unprivileged_userns_clone=1"));
}

TEST(NamespaceRefusalTest, NamesTheFlagsOfAContainer) {
  EXPECT_THAT(ExplainRefusal("unshare", EPERM, {.seccomp_filter = true}),
              AllOf(HasSubstr("--cap-add SYS_ADMIN --cap-add NET_ADMIN"),
                    HasSubstr("--security-opt seccomp=unconfined")));
}

TEST(NamespaceRefusalTest, NamesEverySettingThatForbids) {
  EXPECT_THAT(ExplainRefusal("unshare", EPERM, {.apparmor_restricts = 1, .seccomp_filter = true}),
              AllOf(HasSubstr("apparmor_restrict_unprivileged_userns"), HasSubstr("docker run")));
}

TEST(NamespaceRefusalTest, DoesNotBlameASettingThatAllows) {
  EXPECT_THAT(ExplainRefusal(
                  "unshare", EPERM,
                  {.max_user_namespaces = 100, .unprivileged_clone = 1, .apparmor_restricts = 0}),
              Not(HasSubstr("sysctl")));
}

TEST(NamespaceRefusalTest, SaysWhenTheKernelHasNoVirtualEthernetAndWhatWorksWithout) {
  EXPECT_THAT(ExplainRefusal("making a veth pair", EOPNOTSUPP, {}),
              AllOf(HasSubstr("sudo modprobe veth"), HasSubstr("leave --interface-name out")));
}

TEST(NamespaceRefusalTest, SaysWhenTheKernelHasNoNamespaces) {
  EXPECT_THAT(ExplainRefusal("unshare", EINVAL, {}), HasSubstr("CONFIG_USER_NS"));
}

}  // namespace
}  // namespace understudy::exec
