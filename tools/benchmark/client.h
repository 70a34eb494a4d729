// The other end of the bus: clients of the daemon and of each other.
#pragma once

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include <poll.h>

#include "base/bell.h"
#include "bus/reader.h"
#include "wire/topics.h"

namespace understudy::bench {

// What the two wire families call the same thing.
struct GoFamily {
  using LowCmd = unitree_go_msg_dds__LowCmd_;
  using LowState = unitree_go_msg_dds__LowState_;
  static constexpr const bus::Topic<LowCmd>& kLowCmd = wire::kGoLowCmd;
  static constexpr const bus::Topic<LowState>& kLowState = wire::kGoLowState;
};
struct HgFamily {
  using LowCmd = unitree_hg_msg_dds__LowCmd_;
  using LowState = unitree_hg_msg_dds__LowState_;
  static constexpr const bus::Topic<LowCmd>& kLowCmd = wire::kHgLowCmd;
  static constexpr const bus::Topic<LowState>& kLowState = wire::kHgLowState;
};

// A reader that sleeps until something has come, as the vendor's clients do.
template <typename Msg>
class WaitingReader {
 public:
  WaitingReader(const bus::Participant& participant, const bus::Topic<Msg>& topic)
      : reader_(participant, topic, {.bell = &bell_}) {}

  // False when nothing came in time.
  bool Wait(std::chrono::nanoseconds patience) const {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(patience).count();
    pollfd rung{.fd = bell_.fd(), .events = POLLIN, .revents = 0};
    return ::poll(&rung, 1, static_cast<int>(std::max<decltype(left)>(left, 0))) > 0 &&
           bell_.Answer();
  }

  // As bus::Reader::Take does.
  template <typename Visit>
  int Take(Visit&& visit) {
    return reader_.Take(std::forward<Visit>(visit));
  }
  int matched_writers() const { return reader_.matched_writers(); }

 private:
  Bell bell_;
  bus::Reader<Msg> reader_;
};

// The command line that starts this program as a helper of itself: "echo" or "listen".
std::vector<std::string> HelperArguments(const std::string& helper, const std::string& robot);

// The helpers; they run until they are ended. Echo answers every LowCmd on bench/ping with a
// LowState on bench/pong. Listen reads rt/lowstate.
[[noreturn]] void RunHelper(const std::string& helper, const std::string& robot);

}  // namespace understudy::bench
