// Explains why the kernel refuses a private network and which setting allows it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace understudy::exec {

// The machine's settings for namespaces. nullopt: the kernel has no such setting.
struct NamespacePolicy {
  std::optional<std::int64_t> max_user_namespaces{};  // user.max_user_namespaces; 0 forbids
  std::optional<std::int64_t> max_net_namespaces{};   // user.max_net_namespaces; 0 forbids
  std::optional<std::int64_t> unprivileged_clone{};   // kernel.unprivileged_userns_clone; 0 forbids
  std::optional<std::int64_t> apparmor_restricts{};  // kernel.apparmor_restrict_unprivileged_userns
  bool seccomp_filter = false;                       // this process has one, as in a container

  // Reads them from /proc; those that cannot be read are nullopt.
  static NamespacePolicy OfThisMachine();
};

// Returns one line: what failed (`step`, as in "raising lo"), the text of `error` (an errno), each
// setting of `policy` that explains it, with its remedy, and the option to run without a private
// network. If no setting explains it, the line lists the usual causes.
std::string ExplainRefusal(const std::string& step, int error, const NamespacePolicy& policy);

// Throws BusError with that line, for this machine's policy.
[[noreturn]] void RefuseNetwork(const std::string& step, int error);

}  // namespace understudy::exec
