// Saves the capabilities of this process and restores them after a user namespace has granted all
// of them.
#pragma once

#include <cstdint>

namespace understudy::exec {

// Sets of capabilities, one bit per number of capabilities(7). Without the ambient set, which
// entering a user namespace empties.
struct Capabilities {
  std::uint64_t effective{};
  std::uint64_t permitted{};
  std::uint64_t inheritable{};
  std::uint64_t bounding{};  // limit of what an exec as uid 0 can grant

  // Returns those of the calling thread.
  static Capabilities OfThisThread();

  bool CanUse(int capability) const { return (effective >> capability & 1U) != 0; }

  // Sets those of the calling thread. It can only drop capabilities: for one that the thread does
  // not have it returns false and sets errno. Shrinking `bounding` needs CAP_SETPCAP.
  [[nodiscard]] bool Apply() const;
};

}  // namespace understudy::exec
