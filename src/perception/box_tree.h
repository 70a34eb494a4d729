// A tree of boxes that finds which items a ray may meet.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "perception/ray.h"

namespace understudy::perception {

// An axis-parallel box that is a little larger than what it was made of, so that rounding loses no
// hit of a ray that begins within a kilometre of the frame's origin.
struct Box {
  static constexpr float kMargin = 1e-4F;  // m
  std::array<float, 3> low{kEmpty, kEmpty, kEmpty};
  std::array<float, 3> high{-kEmpty, -kEmpty, -kEmpty};

  static Box Around(const Eigen::Vector3d& low, const Eigen::Vector3d& high);
  void Add(const Box& other);
  float HalfArea() const;

 private:
  static constexpr float kEmpty = 1e30F;
};

// Each node has up to four children, whose boxes are tested at once. Allocates in the constructor
// only.
class BoxTree {
 public:
  BoxTree() = default;
  // Splits by the surface heuristic. A leaf has up to `leaf` items, at most 15.
  BoxTree(std::span<const Box> boxes, int leaf);

  // Follows items that have moved; their number is that of the constructor. The tree keeps its
  // form, so it gets slower as items that were neighbours move apart.
  void Refit(std::span<const Box> boxes);

  // Numbers the items in the order of the leaves: item i is then the one that was order[i].
  std::vector<std::uint32_t> Renumber();

  // Calls meet(item) for what the ray may meet before *nearest [m], nearest boxes first. `meet` may
  // lower *nearest.
  template <class Meet>
  void Walk(const Ray& ray, const double* nearest, Meet meet) const;

 private:
  using Four = float __attribute__((vector_size(16)));
  struct Node {
    std::array<Four, 3> low, high;
    std::array<std::int32_t, 4> child;  // a node, or the complement of a leaf's first << 4 | count
  };
  struct Range {
    std::uint32_t from, to;
  };
  struct Entry {
    std::int32_t child;
    float distance;
  };
  static constexpr std::int32_t kNone = std::numeric_limits<std::int32_t>::max();
  // Below this depth ranges are halved, so that no walk needs more than kMostEntries.
  static constexpr int kMostSplits = 20;
  static constexpr std::size_t kMostEntries = 128;

  std::int32_t Split(std::span<const Box> boxes, Range whole, int depth);
  std::uint32_t Cut(std::span<const Box> boxes, Range range, bool halve);
  static void Set(Node* node, std::size_t k, const Box& box);

  std::vector<Node> nodes_;  // parents before children
  std::vector<std::uint32_t> items_;
  std::uint32_t leaf_ = 1;
};

template <class Meet>
void BoxTree::Walk(const Ray& ray, const double* nearest, Meet meet) const {
  if (nodes_.empty()) return;
  constexpr float kSlack = 1.000001F;  // more than the rounding of a product
  constexpr float kSteepest = 1e18F;
  std::array<Four, 3> origin, inverse;
  std::array<bool, 3> back;
  for (int i = 0; i < 3; ++i) {
    const auto along = static_cast<float>(ray.direction[i]);
    const float inv = std::abs(along) * kSteepest < 1 ? std::copysign(kSteepest, along) : 1 / along;
    const auto axis = static_cast<std::size_t>(i);
    origin[axis] = Four{} + static_cast<float>(ray.origin[i]);
    inverse[axis] = Four{} + inv;
    back[axis] = inv < 0;
  }
  std::array<Entry, kMostEntries> stack;  // the nearest on top
  std::size_t top = 0;
  stack[top++] = {0, 0};
  while (top > 0) {
    const Entry entry = stack[--top];
    if (entry.distance > *nearest) continue;
    if (entry.child < 0) {
      const std::uint32_t code = ~static_cast<std::uint32_t>(entry.child);
      for (std::uint32_t i = code >> 4; i < (code >> 4) + (code & 15); ++i) meet(items_[i]);
      continue;
    }
    const Node& node = nodes_[static_cast<std::size_t>(entry.child)];
    Four in{};
    Four out = Four{} + static_cast<float>(*nearest) * kSlack;
    for (std::size_t i = 0; i < 3; ++i) {
      const Four a = ((back[i] ? node.high[i] : node.low[i]) - origin[i]) * inverse[i];
      const Four b = ((back[i] ? node.low[i] : node.high[i]) - origin[i]) * inverse[i] * kSlack;
      in = in > a ? in : a;
      out = out < b ? out : b;
    }
    const std::size_t begin = top;
    for (std::size_t k = 0; k < 4; ++k) {
      if (!(in[k] <= out[k]) || node.child[k] == kNone) continue;
      std::size_t at = top++;
      for (; at > begin && stack[at - 1].distance < in[k]; --at) stack[at] = stack[at - 1];
      stack[at] = {node.child[k], in[k]};
    }
  }
}

}  // namespace understudy::perception
