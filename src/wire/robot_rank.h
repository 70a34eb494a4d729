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
// it of what the others announce, independent of their clocks.
struct RobotRank {
  std::int64_t since = 0;     // when it began to start, by its clock; ns since 1970
  bus::ParticipantKey key{};  // decides between equal times

  friend auto operator<=>(const RobotRank&, const RobotRank&) = default;
};

// Returns what a robot's participant announces, and play's, which is one to others.
std::string AnnounceRobot(std::int64_t since, std::string_view partition = "");

// Returns the rank of the participant that announces `text`; nullopt if it is no robot of this
// program in that DDS partition.
std::optional<RobotRank> RankOf(std::string_view text, const bus::ParticipantKey& key,
                                std::string_view partition = "");

}  // namespace understudy::wire
