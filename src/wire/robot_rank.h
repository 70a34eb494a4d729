// Which of several robots of this program goes first on a network.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "bus/participant.h"

namespace understudy::wire {

// The one with the least rank stays, the others yield. Robots compute it alike, since each computes
// it of what the others announce, whatever their clocks say.
struct RobotRank {
  std::int64_t since = 0;     // when it began to start, by its clock; ns since 1970
  bus::ParticipantKey key{};  // decides between equal times

  friend auto operator<=>(const RobotRank&, const RobotRank&) = default;
};

// Returns what a robot's participant announces, and play's, which is one to others.
std::string AnnounceRobot(std::int64_t since);

// Returns the rank of the participant that announces `text`; nullopt if it is no robot of this
// program.
std::optional<RobotRank> RankOf(std::string_view text, const bus::ParticipantKey& key);

}  // namespace understudy::wire
