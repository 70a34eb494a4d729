#include "wire/strangers.h"

#include <algorithm>
#include <string_view>

#include "wire/topics.h"

namespace understudy::wire {
namespace {

// As many samples as a poll can visit; with fewer, one stranger's would displace another's.
constexpr bus::ReaderOptions kEar{.depth = bus::kMaxTake, .reliable = false, .foreign_only = true};

}  // namespace

StrangerWatch::StrangerWatch(const bus::Participant& participant)
    : participant_(participant),
      ours_(RankOf(participant.announcement(), participant.key(), participant.partition())),
      watch_(participant, kGoLowState.name),
      announcements_(participant),
      go_{.topic = kGoLowState},
      hg_{.topic = kHgLowState} {}

StrangerWatch::News StrangerWatch::Poll() {
  News news;
  announced_ = announcements_.Poll();
  const std::vector<bus::Neighbour>& writers = watch_.Poll();
  std::erase_if(strangers_, [&](const Stranger& stranger) {
    return std::ranges::none_of(writers, [&](const bus::Neighbour& writer) {
      return writer.participant == stranger.who.participant;
    });
  });
  for (const bus::Neighbour& writer : writers) {
    const auto same = [&](const Stranger& stranger) {
      return stranger.who.participant == writer.participant;
    };
    if (std::ranges::any_of(strangers_, same)) continue;
    strangers_.push_back({.who = writer});
    news.appeared.push_back(writer);
  }
  // Always reads the samples: one left unread would be taken for a later publication.
  Hear(&go_, writers, &news);
  Hear(&hg_, writers, &news);
  return news;
}

template <typename Msg>
void StrangerWatch::Hear(Ear<Msg>* ear, const std::vector<bus::Neighbour>& writers, News* news) {
  const std::string_view type = bus::TypeName(*ear->topic.descriptor);
  if (std::ranges::none_of(writers, [&](const auto& one) { return one.type == type; })) {
    ear->reader.reset();
    return;
  }
  if (!ear->reader) ear->reader.emplace(participant_, ear->topic, kEar);
  ear->reader->Take([&](const Msg&, bus::WriterHandle writer) {
    const auto is_silent = [](const Stranger& stranger) { return !stranger.speaks; };
    if (std::ranges::none_of(strangers_, is_silent)) return;
    const std::optional<bus::ParticipantKey> speaker = ear->reader->ParticipantOf(writer);
    for (Stranger& stranger : strangers_) {
      if (stranger.speaks || stranger.who.participant != speaker) continue;
      stranger.speaks = true;
      news->spoke.push_back(stranger.who);
    }
  });
}

StrangerWatch::Kind StrangerWatch::KindOf(const bus::Announcement& announcement) const {
  const std::optional<RobotRank> theirs =
      RankOf(announcement.text, announcement.participant, participant_.partition());
  if (!ours_ || !theirs) return Kind::kOther;
  return *theirs < *ours_ ? Kind::kElder : Kind::kYounger;
}

StrangerWatch::Kind StrangerWatch::KindOf(const bus::Neighbour& stranger) const {
  const auto found =
      std::ranges::find(announced_, stranger.participant, &bus::Announcement::participant);
  return found == announced_.end() ? Kind::kOther : KindOf(*found);
}

std::vector<bus::Neighbour> StrangerWatch::EldersStarting() const {
  std::vector<bus::Neighbour> elders;
  for (const bus::Announcement& one : announced_) {
    const bool writes = std::ranges::any_of(strangers_, [&](const Stranger& stranger) {
      return stranger.who.participant == one.participant;
    });
    if (!writes && KindOf(one) == Kind::kElder) elders.push_back(one.who);
  }
  return elders;
}

std::vector<bus::Neighbour> StrangerWatch::WhoseSpeech(bool speaks) const {
  std::vector<bus::Neighbour> some;
  for (const Stranger& stranger : strangers_) {
    if (stranger.speaks == speaks) some.push_back(stranger.who);
  }
  return some;
}

std::string Describe(const std::vector<bus::Neighbour>& neighbours) {
  std::string text;
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    if (i > 0) text += i + 1 == neighbours.size() ? " and " : ", ";
    text += bus::Describe(neighbours[i]);
  }
  return text;
}

}  // namespace understudy::wire
