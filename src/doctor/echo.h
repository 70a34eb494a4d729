// The round trip: who answers (`doctor --echo`) and who asks.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/bell.h"
#include "bus/discovery.h"
#include "bus/participant.h"
#include "doctor/measurements.h"

namespace understudy::doctor {

// What a participant announces that answers by that name, and the name in an announcement; nullopt
// if it is none of an echo. 64 characters at most are read.
std::string AnnounceEcho(const std::string& name);
std::optional<std::string> EchoName(std::string_view announcement);

// Returns the IPv4 addresses, in the host's byte order and without those of groups, that a
// participant announces (bus::Neighbour::addresses), as in
// "udp/239.255.0.1:7400@2,udp/192.168.123.222:33485@2".
std::vector<std::uint32_t> AnnouncedAddresses(const std::string& text);

// Answers pings of both families that are for its participant.
class EchoServer {
 public:
  // Rings `bell` when something has arrived. Both must outlive it. Throws BusError.
  EchoServer(const bus::Participant& participant, const Bell* bell);
  ~EchoServer();

  // Answers what has arrived. Never blocks.
  void Answer();
  std::uint64_t answered() const { return answered_; }

 private:
  template <class Family>
  struct Half;

  std::uint32_t tag_;
  std::uint64_t answered_ = 0;
  std::unique_ptr<Half<struct GoEcho>> go_;
  std::unique_ptr<Half<struct HgEcho>> hg_;
};

// Sends pings to one participant and times the answers.
class EchoClient {
 public:
  using Time = std::chrono::nanoseconds;  // as time::Clock

  virtual ~EchoClient() = default;
  // Sends a ping that is only to find out whether somebody answers.
  virtual void Try(std::uint32_t target) = 0;
  // Sends one that counts.
  virtual void Send(std::uint32_t target, Time now) = 0;
  // Takes the answers that have arrived, by `now`. Each ping is answered once at most.
  virtual void Receive(Time now) = 0;

  bool answered() const { return answered_; }  // of any, also of Try
  int sent() const { return static_cast<int>(sent_at_.size()); }
  const std::vector<double>& durations() const { return durations_; }  // there and back, s
  // By the quickest answer; nullopt before one.
  const std::optional<ClockOffset>& offset() const { return offset_; }

 protected:
  // Takes an answer that arrived `now`, at `ours` of the system's clock, and was written at
  // `theirs` of the other's.
  void Note(std::uint32_t number, Time now, std::chrono::nanoseconds ours,
            std::chrono::nanoseconds theirs);

  std::vector<std::optional<Time>> sent_at_;  // nullopt: answered
  std::vector<double> durations_;
  std::optional<ClockOffset> offset_;
  bool answered_ = false;
};

// `session` tells its answers from those of others. Rings `bell` when something has arrived; both
// must outlive it. Throws BusError.
std::unique_ptr<EchoClient> MakeEchoClient(const bus::Participant& participant, const Bell* bell,
                                           bool hg, std::uint32_t session);

}  // namespace understudy::doctor
