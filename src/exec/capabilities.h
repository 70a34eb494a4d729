// Saves the capabilities of this process and restores them after a user namespace has granted all.
#pragma once

#include <cstdint>

namespace understudy::exec {

// One bit per capability number of capabilities(7). The ambient set is left out: entering a user
// namespace empties it.
struct Capabilities {
  std::uint64_t effective{};
  std::uint64_t permitted{};
  std::uint64_t inheritable{};
  std::uint64_t bounding{};  // what an exec of uid 0 may give at most

  // Those of the calling thread.
  static Capabilities OfThisThread();

  bool CanUse(int capability) const { return (effective >> capability & 1U) != 0; }

  // Makes them those of the calling thread. Only giving up is possible: the kernel refuses a set
  // that the thread does not hold (returns false, errno set). Shrinking `bounding` needs
  // CAP_SETPCAP.
  [[nodiscard]] bool Apply() const;
};

}  // namespace understudy::exec
