#include "perception/box_tree.h"

#include <algorithm>
#include <numeric>

namespace understudy::perception {

Box Box::Around(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  Box box;
  for (int i = 0; i < 3; ++i) {
    box.low[static_cast<std::size_t>(i)] = static_cast<float>(low[i]) - kMargin;
    box.high[static_cast<std::size_t>(i)] = static_cast<float>(high[i]) + kMargin;
  }
  return box;
}

void Box::Add(const Box& other) {
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = std::min(low[i], other.low[i]);
    high[i] = std::max(high[i], other.high[i]);
  }
}

float Box::HalfArea() const {
  const float x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
  return x < 0 ? 0 : x * y + y * z + z * x;
}

BoxTree::BoxTree(std::span<const Box> boxes, int leaf)
    : items_(boxes.size()), leaf_(static_cast<std::uint32_t>(leaf)) {
  std::iota(items_.begin(), items_.end(), 0U);
  if (!boxes.empty()) Split(boxes, {0, static_cast<std::uint32_t>(boxes.size())}, 0);
}

void BoxTree::Refit(std::span<const Box> boxes) {
  for (auto node = nodes_.rbegin(); node != nodes_.rend(); ++node) {
    for (std::size_t k = 0; k < 4; ++k) {
      Box box;
      if (node->child[k] == kNone) continue;
      if (node->child[k] < 0) {
        const std::uint32_t code = ~static_cast<std::uint32_t>(node->child[k]);
        for (std::uint32_t i = code >> 4; i < (code >> 4) + (code & 15); ++i) {
          box.Add(boxes[items_[i]]);
        }
      } else {
        const Node& below = nodes_[static_cast<std::size_t>(node->child[k])];
        for (std::size_t i = 0; i < 3; ++i) {
          for (std::size_t j = 0; j < 4; ++j) {
            box.low[i] = std::min(box.low[i], below.low[i][j]);
            box.high[i] = std::max(box.high[i], below.high[i][j]);
          }
        }
      }
      Set(&*node, k, box);
    }
  }
}

std::vector<std::uint32_t> BoxTree::Renumber() {
  std::vector<std::uint32_t> order = items_;
  std::iota(items_.begin(), items_.end(), 0U);
  return order;
}

void BoxTree::Set(Node* node, std::size_t k, const Box& box) {
  for (std::size_t i = 0; i < 3; ++i) {
    node->low[i][k] = box.low[i];
    node->high[i][k] = box.high[i];
  }
}

// Orders the items of a range and returns where its second part begins.
std::uint32_t BoxTree::Cut(std::span<const Box> boxes, Range range, bool halve) {
  constexpr int kBins = 16;
  const std::uint32_t middle = (range.from + range.to) / 2;
  if (halve) return middle;
  const auto centre = [&boxes](std::uint32_t item, std::size_t axis) {
    return boxes[item].low[axis] + boxes[item].high[axis];
  };
  float best = std::numeric_limits<float>::infinity();
  std::size_t best_axis = 0;
  float best_from = 0, best_scale = 0;
  int best_bin = -1;
  const auto bin_of = [](float at, float from, float scale) {
    return std::clamp(static_cast<int>((at - from) * scale), 0, kBins - 1);
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    float from = std::numeric_limits<float>::infinity(), to = -from;
    for (std::uint32_t i = range.from; i < range.to; ++i) {
      from = std::min(from, centre(items_[i], axis));
      to = std::max(to, centre(items_[i], axis));
    }
    if (!(to > from)) continue;
    const float scale = kBins / (to - from);
    std::array<Box, kBins> bins;
    std::array<float, kBins> counts{};
    for (std::uint32_t i = range.from; i < range.to; ++i) {
      const auto bin = static_cast<std::size_t>(bin_of(centre(items_[i], axis), from, scale));
      bins[bin].Add(boxes[items_[i]]);
      ++counts[bin];
    }
    std::array<float, kBins> right{};
    Box sum;
    float count = 0;
    for (std::size_t k = kBins - 1; k > 0; --k) {
      sum.Add(bins[k]);
      count += counts[k];
      right[k] = sum.HalfArea() * count;
    }
    sum = Box();
    count = 0;
    for (std::size_t k = 0; k + 1 < kBins; ++k) {
      sum.Add(bins[k]);
      count += counts[k];
      const float cost = sum.HalfArea() * count + right[k + 1];
      if (cost >= best) continue;
      best = cost;
      best_axis = axis;
      best_from = from;
      best_scale = scale;
      best_bin = static_cast<int>(k);
    }
  }
  if (best_bin < 0) return middle;  // all centres are one
  const auto second = std::partition(
      items_.begin() + range.from, items_.begin() + range.to, [&](std::uint32_t item) {
        return bin_of(centre(item, best_axis), best_from, best_scale) <= best_bin;
      });
  return static_cast<std::uint32_t>(second - items_.begin());
}

std::int32_t BoxTree::Split(std::span<const Box> boxes, Range whole, int depth) {
  std::array<Range, 4> parts{whole};
  std::size_t count = 1;
  while (count < parts.size()) {
    const auto largest = std::max_element(
        parts.begin(), parts.begin() + count,
        [](const Range& a, const Range& b) { return a.to - a.from < b.to - b.from; });
    if (largest->to - largest->from <= leaf_) break;
    const std::uint32_t second = Cut(boxes, *largest, depth >= kMostSplits);
    parts[count++] = {second, largest->to};
    largest->to = second;
  }
  const std::size_t at = nodes_.size();
  nodes_.emplace_back();
  for (std::size_t k = 0; k < 4; ++k) {
    Box box;
    std::int32_t child = kNone;
    if (k < count) {
      for (std::uint32_t i = parts[k].from; i < parts[k].to; ++i) box.Add(boxes[items_[i]]);
      const std::uint32_t size = parts[k].to - parts[k].from;
      child = size <= leaf_ ? ~static_cast<std::int32_t>(parts[k].from << 4 | size)
                            : Split(boxes, parts[k], depth + 1);
    }
    Set(&nodes_[at], k, box);
    nodes_[at].child[k] = child;
  }
  return static_cast<std::int32_t>(at);
}

}  // namespace understudy::perception
