#include "exec/capabilities.h"

#include <array>

#include <linux/capability.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace understudy::exec {
namespace {

using CapabilityWords = std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3>;

__user_cap_header_struct ThisThread() { return {.version = _LINUX_CAPABILITY_VERSION_3, .pid = 0}; }

std::uint64_t Join(std::uint32_t low, std::uint32_t high) {
  return std::uint64_t{high} << 32U | low;
}

std::uint32_t Low(std::uint64_t set) { return static_cast<std::uint32_t>(set); }
std::uint32_t High(std::uint64_t set) { return static_cast<std::uint32_t>(set >> 32U); }

}  // namespace

Capabilities Capabilities::OfThisThread() {
  Capabilities now;
  __user_cap_header_struct header = ThisThread();
  CapabilityWords words{};
  if (::syscall(SYS_capget, &header, words.data()) == 0) {
    now.effective = Join(words[0].effective, words[1].effective);
    now.permitted = Join(words[0].permitted, words[1].permitted);
    now.inheritable = Join(words[0].inheritable, words[1].inheritable);
  }
  // The result is -1 for a capability number that this kernel does not know.
  for (int capability = 0; capability < 64; ++capability) {
    if (::prctl(PR_CAPBSET_READ, capability, 0, 0, 0) == 1) now.bounding |= 1ULL << capability;
  }
  return now;
}

bool Capabilities::Apply() const {
  // The bounding set first: shrinking it needs a capability that the second step may drop.
  for (int capability = 0; capability < 64; ++capability) {
    const bool held = ::prctl(PR_CAPBSET_READ, capability, 0, 0, 0) == 1;
    if (held && (bounding >> capability & 1U) == 0 &&
        ::prctl(PR_CAPBSET_DROP, capability, 0, 0, 0) != 0) {
      return false;
    }
  }
  __user_cap_header_struct header = ThisThread();
  const CapabilityWords words{{{Low(effective), Low(permitted), Low(inheritable)},
                               {High(effective), High(permitted), High(inheritable)}}};
  return ::syscall(SYS_capset, &header, words.data()) == 0;
}

}  // namespace understudy::exec
