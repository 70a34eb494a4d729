#include "exec/namespace_refusal.h"

#include <cerrno>
#include <fstream>
#include <system_error>
#include <vector>

#include "base/errors.h"

namespace understudy::exec {
namespace {

std::optional<std::int64_t> ReadNumber(const char* path) {
  std::ifstream file(path);
  std::int64_t value = 0;
  if (!(file >> value)) return std::nullopt;
  return value;
}

bool UnderSeccompFilter() {
  constexpr int kFilterMode = 2;  // proc(5), field Seccomp of status
  std::ifstream status("/proc/self/status");
  std::string key;
  int mode = 0;
  while (status >> key) {
    if (key == "Seccomp:" && status >> mode) return mode == kFilterMode;
    std::getline(status, key);
  }
  return false;
}

std::vector<std::string> ReasonsForNoSpace(const NamespacePolicy& policy) {
  if (policy.max_user_namespaces == 0) {
    return {"user namespaces are switched off: `sudo sysctl user.max_user_namespaces=10000`"};
  }
  if (policy.max_net_namespaces == 0) {
    return {"network namespaces are switched off: `sudo sysctl user.max_net_namespaces=10000`"};
  }
  return {
      "all namespaces that user.max_user_namespaces and user.max_net_namespaces allow are taken"};
}

std::vector<std::string> ReasonsForNotPermitted(const NamespacePolicy& policy) {
  std::vector<std::string> reasons;
  if (policy.unprivileged_clone == 0) {
    reasons.emplace_back(
        "user namespaces are kept from ordinary users: "
        "`sudo sysctl kernel.unprivileged_userns_clone=1`");
  }
  if (policy.apparmor_restricts.value_or(0) != 0) {
    reasons.emplace_back(
        "AppArmor restricts user namespaces: "
        "`sudo sysctl kernel.apparmor_restrict_unprivileged_userns=0`");
  }
  if (policy.seccomp_filter) {
    reasons.emplace_back(
        "a system call filter is in force, as in a container: "
        "`docker run --cap-add SYS_ADMIN --cap-add NET_ADMIN`, or "
        "`--security-opt seccomp=unconfined` for a user without rights");
  }
  if (reasons.empty()) {
    reasons.emplace_back("a security module, a chroot or a container's policy forbids it");
  }
  return reasons;
}

std::vector<std::string> Reasons(int error, const NamespacePolicy& policy) {
  switch (error) {
    case ENOSPC:
    case EUSERS:  // ENOSPC's name before Linux 4.9
      return ReasonsForNoSpace(policy);
    case EPERM:
    case EACCES:
      return ReasonsForNotPermitted(policy);
    case EINVAL:
    case ENOSYS:
      return {"the kernel needs CONFIG_USER_NS and CONFIG_NET_NS"};
    case EOPNOTSUPP:  // rtnetlink's word for a kind of interface that it does not know
      return {
          "the kernel has no virtual Ethernet: `sudo modprobe veth` (CONFIG_VETH); or leave "
          "--interface-name out: the private network then has lo alone"};
    default:
      return {};
  }
}

}  // namespace

NamespacePolicy NamespacePolicy::OfThisMachine() {
  return {
      .max_user_namespaces = ReadNumber("/proc/sys/user/max_user_namespaces"),
      .max_net_namespaces = ReadNumber("/proc/sys/user/max_net_namespaces"),
      .unprivileged_clone = ReadNumber("/proc/sys/kernel/unprivileged_userns_clone"),
      .apparmor_restricts = ReadNumber("/proc/sys/kernel/apparmor_restrict_unprivileged_userns"),
      .seccomp_filter = UnderSeccompFilter()};
}

std::string ExplainRefusal(const std::string& step, int error, const NamespacePolicy& policy) {
  std::string line =
      "no private network: " + step + " failed: " + std::generic_category().message(error);
  for (const std::string& reason : Reasons(error, policy)) line += "; " + reason;
  return line + "; or share the machine's network with --network host";
}

void RefuseNetwork(const std::string& step, int error) {
  throw BusError(ExplainRefusal(step, error, NamespacePolicy::OfThisMachine()));
}

}  // namespace understudy::exec
