#include "wire/robot_rank.h"

#include <charconv>

namespace understudy::wire {
namespace {

constexpr std::string_view kAnnounced = "understudy robot since ";
constexpr std::string_view kIn = " in ";

}  // namespace

std::string AnnounceRobot(std::int64_t since, std::string_view partition) {
  std::string text = std::string(kAnnounced) + std::to_string(since);
  if (!partition.empty()) text.append(kIn).append(partition);
  return text;
}

std::optional<RobotRank> RankOf(std::string_view text, const bus::ParticipantKey& key,
                                std::string_view partition) {
  if (!text.starts_with(kAnnounced)) return std::nullopt;
  text.remove_prefix(kAnnounced.size());
  const std::size_t in = text.find(kIn);
  const std::string_view theirs =
      in == std::string_view::npos ? std::string_view() : text.substr(in + kIn.size());
  if (theirs != partition) return std::nullopt;
  text = text.substr(0, in);
  RobotRank rank{.key = key};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), rank.since);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return rank;
}

}  // namespace understudy::wire
