#include "wire/robot_rank.h"

#include <charconv>

namespace understudy::wire {
namespace {

constexpr std::string_view kAnnounced = "understudy robot since ";

}  // namespace

std::string AnnounceRobot(std::int64_t since) {
  return std::string(kAnnounced) + std::to_string(since);
}

std::optional<RobotRank> RankOf(std::string_view text, const bus::ParticipantKey& key) {
  if (!text.starts_with(kAnnounced)) return std::nullopt;
  text.remove_prefix(kAnnounced.size());
  RobotRank rank{.key = key};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), rank.since);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return rank;
}

}  // namespace understudy::wire
