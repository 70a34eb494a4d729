// Topics of the round trip: names that cannot collide with vendor topics; types of LowCmd and
// LowState, for messages as large as those.
#pragma once

#include <cstdint>
#include <string_view>

#include "bus/participant.h"
#include "bus/topic.h"
#include "idl/unitree_go.h"
#include "idl/unitree_hg.h"

namespace understudy::doctor {

inline constexpr std::string_view kEchoPrefix = "understudy_doctor/";

inline bool IsEchoTopic(std::string_view topic) { return topic.starts_with(kEchoPrefix); }

struct GoEcho {
  using Ping = unitree_go_msg_dds__LowCmd_;
  using Pong = unitree_go_msg_dds__LowState_;
  static constexpr bus::Topic<Ping> kPing{"understudy_doctor/go/ping",
                                          &unitree_go_msg_dds__LowCmd__desc};
  static constexpr bus::Topic<Pong> kPong{"understudy_doctor/go/pong",
                                          &unitree_go_msg_dds__LowState__desc};
};

struct HgEcho {
  using Ping = unitree_hg_msg_dds__LowCmd_;
  using Pong = unitree_hg_msg_dds__LowState_;
  static constexpr bus::Topic<Ping> kPing{"understudy_doctor/hg/ping",
                                          &unitree_hg_msg_dds__LowCmd__desc};
  static constexpr bus::Topic<Pong> kPong{"understudy_doctor/hg/pong",
                                          &unitree_hg_msg_dds__LowState__desc};
};

// What a message says; all else in it is 0.
struct Mark {
  std::uint32_t session = 0;  // of who asks
  std::uint32_t target = 0;   // TagOf who is to answer
  std::uint32_t number = 0;   // 0: only to try whether somebody answers

  friend bool operator==(const Mark&, const Mark&) = default;
};

// When an answer was written, ns since 1970 by the clock of who answers.
void PutTime(std::int64_t time, GoEcho::Pong* message);
void PutTime(std::int64_t time, HgEcho::Pong* message);
std::int64_t TimeOf(const GoEcho::Pong& message);
std::int64_t TimeOf(const HgEcho::Pong& message);

// Returns a number for a participant, which another has with a chance of 2^-32.
std::uint32_t TagOf(const bus::ParticipantKey& participant);

// Put a mark into a message, and read it.
void Put(const Mark& mark, GoEcho::Ping* message);
void Put(const Mark& mark, GoEcho::Pong* message);
void Put(const Mark& mark, HgEcho::Ping* message);
void Put(const Mark& mark, HgEcho::Pong* message);
Mark MarkOf(const GoEcho::Ping& message);
Mark MarkOf(const GoEcho::Pong& message);
Mark MarkOf(const HgEcho::Ping& message);
Mark MarkOf(const HgEcho::Pong& message);

}  // namespace understudy::doctor
