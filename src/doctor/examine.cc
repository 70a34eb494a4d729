#include "doctor/examine.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <string_view>
#include <thread>
#include <vector>

#include <netdb.h>
#include <poll.h>

#include "base/bell.h"
#include "base/errors.h"
#include "base/signals.h"
#include "bus/discovery.h"
#include "bus/participant.h"
#include "bus/reader.h"
#include "doctor/echo.h"
#include "doctor/echo_topics.h"
#include "doctor/probe.h"
#include "doctor/states_watch.h"
#include "doctor/system.h"
#include "time/clock.h"
#include "wire/strangers.h"
#include "wire/topics.h"

namespace understudy::doctor {
namespace {

using Time = time::Clock::Time;
using std::chrono::milliseconds;

constexpr milliseconds kPeriod(2);     // of LowCmd
constexpr milliseconds kAskEvery(50);  // *assumed*, as the figures below
constexpr milliseconds kTryEvery(50);
constexpr milliseconds kPatience(2000);  // to find the peer: discovery takes some 0.1 s
constexpr milliseconds kGrace(500);      // for what is under way at the end, with a peer
constexpr milliseconds kOwnGrace(50);    // and without

// Sleeps until then, or until one of the descriptors is readable; returns whether one is.
bool SleepUntil(Time then, std::span<pollfd> descriptors, time::Clock* clock) {
  const Time left = std::max(then - clock->Now(), Time(0));
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(left);
  const timespec wait{.tv_sec = seconds.count(), .tv_nsec = (left - seconds).count()};
  return ::ppoll(descriptors.data(), descriptors.size(), &wait, nullptr) > 0;
}

pollfd Readable(int fd) { return {.fd = fd, .events = POLLIN, .revents = 0}; }

// The IPv4 addresses of a host, in the host's byte order; none if it is no host's name. Those of
// this machine's loopback count only where that is where we look.
std::vector<std::uint32_t> Resolve(const std::string& host, bool loopback) {
  constexpr std::uint32_t kLoopbackNetwork = 127;
  addrinfo wanted{}, *found = nullptr;
  wanted.ai_family = AF_INET;
  wanted.ai_socktype = SOCK_DGRAM;
  std::vector<std::uint32_t> addresses;
  if (::getaddrinfo(host.c_str(), nullptr, &wanted, &found) != 0) return addresses;
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> owner(found, &::freeaddrinfo);
  for (const addrinfo* one = found; one != nullptr; one = one->ai_next) {
    const auto* const address = reinterpret_cast<const sockaddr_in*>(one->ai_addr);
    const std::uint32_t number = ntohl(address->sin_addr.s_addr);
    if ((number >> 24U == kLoopbackNetwork) == loopback) addresses.push_back(number);
  }
  return addresses;
}

// What is read without the network.
void ReadMachine(Measurements* seen) {
  const std::string& interface = seen->question.interface;
  try {
    for (const bus::NetworkInterface& one : bus::ListInterfaces()) {
      seen->interfaces.push_back(one.name);
    }
  } catch (const BusError&) {  // then there are none to name
  }
  seen->link = ReadLink(interface);
  seen->addresses = ReadAddresses();
  seen->multicast_route = ReadMulticastRoute();
  seen->receive_buffer = GrantedBuffer(true, kCycloneReceive);
  seen->send_buffer = GrantedBuffer(false, kCycloneSend);
  seen->rights = TryRights();
  seen->governors = ReadGovernors();
  seen->load = ReadLoad();
  seen->cores = static_cast<int>(std::thread::hardware_concurrency());
  seen->clock_source = ReadClockSource();
  seen->sync = ReadClockSync();
}

// What we hear on the bus, and what we say to the peer.
class Ear {
 public:
  Ear(const Question& question, const Bell* bell, std::uint32_t session,
      std::vector<std::uint32_t> peer_addresses)
      : peer_(question.peer),
        peer_addresses_(std::move(peer_addresses)),
        participant_(question.interface, question.domain),
        survey_(participant_),
        announcements_(participant_),
        strangers_(participant_),
        go_(participant_, wire::kGoLowState, Loud(bell)),
        hg_(participant_, wire::kHgLowState, Loud(bell)) {
    if (!peer_.empty()) client_ = MakeEchoClient(participant_, bell, question.hg, session);
  }

  // Takes what has arrived.
  void Hear(Time now) {
    if (client_) client_->Receive(now);
    bus::CdrSample sample;
    for (int i = 0; i < bus::kMaxTake && go_.Next(&sample); ++i) states_.Note(now);
    for (int i = 0; i < bus::kMaxTake && hg_.Next(&sample); ++i) states_.Note(now);
  }

  // Takes note of who comes and goes.
  void Look() {
    survey_.Poll();
    strangers_.Poll();
    if (peer_.empty()) return;
    echo_.reset();
    for (const bus::Announcement& one : announcements_.Poll()) {
      if (IsPeer(one)) echo_ = one;
    }
  }

  const std::optional<bus::Announcement>& echo() const { return echo_; }
  // Null without a peer.
  EchoClient* client() { return client_.get(); }
  void StartStates(Time now) { states_ = StatesWatch(now); }

  void Tell(Measurements* seen) const {
    seen->participants = survey_.participants();
    seen->endpoints = survey_.endpoints();
    for (const bus::Neighbour& one : strangers_.speaking()) {
      seen->robots.push_back({.who = bus::Describe(one), .speaks = true});
    }
    for (const bus::Neighbour& one : strangers_.silent()) {
      seen->robots.push_back({.who = bus::Describe(one), .speaks = false});
    }
    seen->states = states_.states();
  }

 private:
  static bus::ReaderOptions Loud(const Bell* bell) {
    return {.depth = bus::kMaxTake, .reliable = false, .foreign_only = true, .bell = bell};
  }

  bool IsPeer(const bus::Announcement& one) const {
    const std::optional<std::string> name = EchoName(one.text);
    if (!name) return false;
    if (*name == peer_ || one.who.host == peer_) return true;
    return std::ranges::any_of(AnnouncedAddresses(one.who.addresses), [&](std::uint32_t address) {
      return std::ranges::find(peer_addresses_, address) != peer_addresses_.end();
    });
  }

  std::string peer_;
  std::vector<std::uint32_t> peer_addresses_;
  bus::Participant participant_;
  bus::EndpointSurvey survey_;
  bus::AnnouncementWatch announcements_;
  wire::StrangerWatch strangers_;
  bus::RawReader<unitree_go_msg_dds__LowState_> go_;
  bus::RawReader<unitree_hg_msg_dds__LowState_> hg_;
  std::unique_ptr<EchoClient> client_;
  StatesWatch states_{Time(0)};
  std::optional<bus::Announcement> echo_;
};

class Examination {
 public:
  explicit Examination(const Question& question) : session_(std::random_device()()) {
    seen_.question = question;
    ReadMachine(&seen_);
    const bool loopback = seen_.link && seen_.link->loopback;
    if (!question.peer.empty()) peer_addresses_ = Resolve(question.peer, loopback);
    OpenProbe();
    OpenEar();
  }

  Measurements Run() {
    const auto dropped = ReadDropCounts(seen_.question.interface);
    if (ear_ && ear_->client() != nullptr) FindPeer();
    Measure();
    Wait(clock_.Now() + (seen_.question.peer.empty() ? kOwnGrace : kGrace));
    if (const auto now = ReadDropCounts(seen_.question.interface); dropped && now) {
      seen_.dropped =
          DropCounts{.interface_errors = now->interface_errors - dropped->interface_errors,
                     .interface_dropped = now->interface_dropped - dropped->interface_dropped,
                     .buffer_full = now->buffer_full - dropped->buffer_full};
    }
    Tell();
    return std::move(seen_);
  }

 private:
  void OpenProbe() {
    const std::string& interface = seen_.question.interface;
    const std::uint32_t own = OwnAddress(seen_.addresses, interface);
    if (own == 0) return;
    try {
      probe_.emplace(interface, own, seen_.question.domain, session_, seen_.question.peer);
      if (!peer_addresses_.empty()) probe_->SetPeer(peer_addresses_.front());
    } catch (const BusError&) {  // multicast here is then not seen
    }
  }

  void OpenEar() {
    try {
      ear_.emplace(seen_.question, &bell_, session_, peer_addresses_);
    } catch (const BusError& error) {
      seen_.no_bus = error.what();
    }
  }

  // Takes what arrives until then.
  void Wait(Time until) {
    do {
      // poll(2) passes over a descriptor of -1.
      std::array<pollfd, 3> descriptors = {Readable(bell_.fd()),
                                           Readable(probe_ ? probe_->own_fd() : -1),
                                           Readable(probe_ ? probe_->group_fd() : -1)};
      const bool slept = !SleepUntil(until, descriptors, &clock_);
      const Time now = clock_.Now();
      bell_.Answer();
      if (ear_) ear_->Hear(now);
      if (probe_) probe_->Receive();
      if (slept && now >= until) {
        lateness_.push_back(std::chrono::duration<double>(now - until).count());
      }
    } while (clock_.Now() < until && StopSignal() == 0);
    clocks_.Note();
  }

  // Until somebody answers, or the patience is over.
  void FindPeer() {
    const Time end = clock_.Now() + kPatience;
    while (clock_.Now() < end && !ear_->client()->answered() && StopSignal() == 0) {
      Look();
      if (const auto& echo = ear_->echo()) ear_->client()->Try(TagOf(echo->participant));
      Wait(clock_.Now() + kTryEvery);
    }
  }

  void Look() {
    if (!ear_) return;
    ear_->Look();
    const auto& echo = ear_->echo();
    if (!echo || !probe_ || probe_->peer() != 0) return;
    const std::vector<std::uint32_t> addresses = AnnouncedAddresses(echo->who.addresses);
    if (!addresses.empty()) probe_->SetPeer(addresses.front());
  }

  void Measure() {
    lateness_.clear();
    const Time start = clock_.Now();
    const Time end = start + std::chrono::duration_cast<Time>(
                                 std::chrono::duration<double>(seen_.question.seconds));
    if (ear_) ear_->StartStates(start);
    Time ask = start;
    for (Time next = start; next < end && StopSignal() == 0;) {
      Look();
      if (ear_ && ear_->client() != nullptr && ear_->echo()) {
        ear_->client()->Send(TagOf(ear_->echo()->participant), clock_.Now());
      }
      if (probe_ && next >= ask) {
        probe_->Ask();
        ask += kAskEvery;
      }
      next += kPeriod;
      Wait(next);
      // What could not be done in time is left out.
      if (const Time now = clock_.Now(); now > next) next += (now - next) / kPeriod * kPeriod;
    }
    seen_.lateness = SpreadOf(lateness_);
  }

  void Tell() {
    seen_.clock = clocks_.course();
    if (probe_) seen_.self_multicast = probe_->self_multicast();
    if (ear_) ear_->Tell(&seen_);
    if (seen_.question.peer.empty()) return;
    Peer& peer = seen_.peer.emplace();
    if (!probe_) {
      peer.no_address = "no socket could be made for it";
    } else if (probe_->peer() == 0) {
      peer.no_address = "no address of '" + seen_.question.peer + "' is known";
    } else {
      peer.unicast = probe_->unicast();
      peer.multicast = probe_->multicast();
      peer.from_peer = probe_->from_peer();
    }
    if (!ear_) return;
    const auto& echo = ear_->echo();
    peer.found = echo.has_value();
    if (echo) peer.who = bus::Describe(echo->who);
    peer.sent = ear_->client()->sent();
    peer.returned = static_cast<int>(ear_->client()->durations().size());
    peer.there_and_back = SpreadOf(ear_->client()->durations());
    peer.offset = ear_->client()->offset();
  }

  std::uint32_t session_;
  time::SteadyClock clock_;
  Measurements seen_;
  std::vector<std::uint32_t> peer_addresses_;
  Bell bell_;
  std::optional<ProbeClient> probe_;
  std::optional<Ear> ear_;
  ClockWatch clocks_;
  std::vector<double> lateness_;  // s
};

}  // namespace

Measurements Examine(const Question& question) { return Examination(question).Run(); }

std::uint64_t Echo(const EchoOptions& options, void (*ready)(const EchoOptions& options)) {
  const Bell bell;
  const bus::Participant participant(options.interface, options.domain, AnnounceEcho(options.name));
  EchoServer echo(participant, &bell);
  ProbeServer probe(options.interface, OwnAddress(ReadAddresses(), options.interface),
                    options.domain, options.name);
  ready(options);
  while (StopSignal() == 0) {
    std::array<pollfd, 2> descriptors = {Readable(bell.fd()), Readable(probe.fd())};
    constexpr int kWhileQuiet = 200;  // ms; a stop signal ends the wait
    ::poll(descriptors.data(), descriptors.size(), kWhileQuiet);
    bell.Answer();
    echo.Answer();
    probe.Answer();
  }
  return echo.answered();
}

}  // namespace understudy::doctor
