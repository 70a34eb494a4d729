#include "wire/strangers.h"

#include <algorithm>

#include "wire/topics.h"

namespace understudy::wire {
namespace {

// As many samples as a poll can visit; with fewer, one stranger's would displace another's.
constexpr bus::ReaderOptions kEar{.depth = bus::kMaxTake, .reliable = false, .foreign_only = true};

}  // namespace

StrangerWatch::StrangerWatch(const bus::Participant& participant)
    : watch_(participant, kGoLowState.name),
      go_(participant, kGoLowState, kEar),
      hg_(participant, kHgLowState, kEar) {}

StrangerWatch::News StrangerWatch::Poll() {
  News news;
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
  Hear(&go_, &news);
  Hear(&hg_, &news);
  return news;
}

template <typename Msg>
void StrangerWatch::Hear(bus::Reader<Msg>* ear, News* news) {
  ear->Take([&](const Msg&, bus::WriterHandle writer) {
    const auto is_silent = [](const Stranger& stranger) { return !stranger.speaks; };
    if (std::ranges::none_of(strangers_, is_silent)) return;
    const std::optional<bus::ParticipantKey> speaker = ear->ParticipantOf(writer);
    for (Stranger& stranger : strangers_) {
      if (stranger.speaks || stranger.who.participant != speaker) continue;
      stranger.speaks = true;
      news->spoke.push_back(stranger.who);
    }
  });
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
