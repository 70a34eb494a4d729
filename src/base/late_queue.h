// A FIFO of values that become due later.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace understudy {

// A queue of values that are due at times that never go back: one that would be sooner than the one
// before waits for it. Keeps the places of values that have gone, so that it stops to allocate once
// it has been as long as it gets.
template <class T>
class LateQueue {
 public:
  static constexpr std::size_t kMost = 4096;

  // Makes room for `count` copies of `like`.
  explicit LateQueue(std::size_t count = 0, const T& like = {}) : places_(count, {0, like}) {}

  bool empty() const { return count_ == 0; }

  // Adds a value that is due at `due` [s] and returns it, with what an earlier one has left in it;
  // null if there are kMost.
  T* Push(double due) {
    if (count_ == kMost) return nullptr;
    if (count_ == places_.size()) Grow();
    if (count_ > 0) due = std::max(due, At(count_ - 1).due);
    Place& place = At(count_++);
    place.due = due;
    return &place.value;
  }

  // Returns the first value if it is due at `now` [s], else null. It is there until Pop.
  T* Due(double now) {
    constexpr double kSlack = 1e-9;  // s: times are sums of steps
    return count_ > 0 && At(0).due <= now + kSlack ? &At(0).value : nullptr;
  }
  void Pop() {
    first_ = (first_ + 1) % places_.size();
    --count_;
  }
  void Clear() { count_ = 0; }

 private:
  struct Place {
    double due = 0;
    T value{};
  };

  Place& At(std::size_t i) { return places_[(first_ + i) % places_.size()]; }
  const Place& At(std::size_t i) const { return places_[(first_ + i) % places_.size()]; }
  void Grow() {
    std::rotate(places_.begin(), places_.begin() + static_cast<std::ptrdiff_t>(first_),
                places_.end());
    first_ = 0;
    places_.resize(std::max<std::size_t>(8, 2 * places_.size()));
  }

  std::vector<Place> places_;  // a ring
  std::size_t first_ = 0;
  std::size_t count_ = 0;
};

}  // namespace understudy
