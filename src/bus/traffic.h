// Counts the messages of a participant's own readers and writers, by topic.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace understudy::bus {

// Messages since the start.
struct TopicTraffic {
  std::uint64_t sent = 0;
  std::uint64_t received = 0;
};

// Any thread may read. Topics are added where readers and writers are made, under a lock; counting
// takes none.
class Traffic {
 public:
  struct Counts {
    std::atomic<std::uint64_t> sent{0};
    std::atomic<std::uint64_t> received{0};
  };

  // Returns the counts of a topic, which live as long as this.
  Counts& Of(const std::string& topic) {
    const std::scoped_lock lock(mutex_);
    std::unique_ptr<Counts>& counts = topics_[topic];
    if (!counts) counts = std::make_unique<Counts>();
    return *counts;
  }

  // Returns what has gone over each topic so far.
  std::map<std::string, TopicTraffic> Read() const {
    const std::scoped_lock lock(mutex_);
    std::map<std::string, TopicTraffic> read;
    for (const auto& [topic, counts] : topics_) {
      read[topic] = {.sent = counts->sent.load(std::memory_order_relaxed),
                     .received = counts->received.load(std::memory_order_relaxed)};
    }
    return read;
  }

 private:
  mutable std::mutex mutex_;
  std::map<std::string, std::unique_ptr<Counts>> topics_;
};

}  // namespace understudy::bus
