// The other end of the bus: clients of the daemon and of each other.
#pragma once

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include <dds/dds.h>

#include "bus/entity.h"
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
class WaitingReader : public bus::Reader<Msg> {
 public:
  WaitingReader(const bus::Participant& participant, const bus::Topic<Msg>& topic)
      : bus::Reader<Msg>(participant, topic),
        condition_(dds_create_readcondition(this->handle(), DDS_ANY_STATE), "wait for a message"),
        waitset_(dds_create_waitset(participant.handle()), "wait for a message") {
    dds_waitset_attach(waitset_.handle(), condition_.handle(), 0);
  }

  // False when nothing came in time.
  bool Wait(std::chrono::nanoseconds patience) const {
    const bool woken = dds_waitset_wait(waitset_.handle(), nullptr, 0, patience.count()) > 0;
    // Cyclone wakes us before it calls the listener that tells the reader of the message. To ask
    // again and again meanwhile keeps it from that for a millisecond; a nap does not.
    if (woken) std::this_thread::sleep_for(std::chrono::microseconds(5));
    return woken;
  }

 private:
  bus::Entity condition_, waitset_;
};

// The command line that starts this program as a helper of itself: "echo" or "listen".
std::vector<std::string> HelperArguments(const std::string& helper, const std::string& robot);

// The helpers; they run until they are ended. Echo answers every LowCmd on bench/ping with a
// LowState on bench/pong. Listen reads rt/lowstate.
[[noreturn]] void RunHelper(const std::string& helper, const std::string& robot);

}  // namespace understudy::bench
