#include "server/bus_view.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "idl/type_table.h"
#include "wire/unserved.h"
#include "wire/who_serves.h"

namespace understudy::server {
namespace {

using nlohmann::ordered_json;

// How long an answer serves all who ask; *assumed*. One takes some milliseconds to make, and
// anybody on this machine may ask.
constexpr std::chrono::milliseconds kFresh(250);

constexpr std::size_t kMostMismatches = 64;  // of a topic; *assumed*

std::string Who(const bus::Endpoint& one) {
  if (one.ours) return "this robot";
  return bus::Describe(bus::Neighbour{
      .host = one.who.host, .process = one.who.process, .pid = one.who.pid, .addresses = {}});
}

ordered_json EndpointJson(const bus::Endpoint& one) {
  return {{"who", Who(one)},
          {"ours", one.ours},
          {"writes", one.writes},
          {"type", one.who.type},
          {"reliable", one.reliable},
          {"durable", one.keeps_for_late},
          {"exclusive", one.exclusive},
          {"deadline", one.has_deadline},
          {"xcdr1", one.xcdr1},
          {"partition", one.partitions}};
}

struct Side {
  std::vector<const bus::Endpoint*> writers, readers;
};

// Why nothing passes from these writers to those readers; "" if something does.
std::string WhyNothingPasses(const std::vector<const bus::Endpoint*>& writers,
                             const std::vector<const bus::Endpoint*>& readers) {
  std::string why;
  for (const bus::Endpoint* writer : writers) {
    for (const bus::Endpoint* reader : readers) {
      std::string not_matched = WhyNotMatched(*writer, *reader);
      if (not_matched.empty()) return "";
      if (why.empty()) why = std::move(not_matched);
    }
  }
  return why;
}

// By participants: a robot listens for others of both families on one topic, so that one reader of
// another type means nothing as long as another one matches.
ordered_json MismatchesJson(const std::vector<const bus::Endpoint*>& endpoints) {
  std::map<bus::ParticipantKey, Side> sides;
  for (const bus::Endpoint* one : endpoints) {
    Side& side = sides[one->who.participant];
    (one->writes ? side.writers : side.readers).push_back(one);
  }
  ordered_json mismatches = ordered_json::array();
  for (const auto& [from, writing] : sides) {
    for (const auto& [to, reading] : sides) {
      if (from == to || mismatches.size() == kMostMismatches) continue;
      const std::string why = WhyNothingPasses(writing.writers, reading.readers);
      if (why.empty()) continue;
      mismatches.push_back({{"writer", Who(*writing.writers.front())},
                            {"reader", Who(*reading.readers.front())},
                            {"why", why}});
    }
  }
  return mismatches;
}

}  // namespace

ordered_json BusJson(const std::vector<bus::Endpoint>& endpoints,
                     const std::map<std::string, bus::TopicTraffic>& traffic, double at) {
  std::map<std::string, std::vector<const bus::Endpoint*>> by_topic;
  for (const bus::Endpoint& one : endpoints) by_topic[one.topic].push_back(&one);
  std::set<std::string> unserved;
  for (const wire::Unserved& one : wire::UnservedIn(endpoints)) unserved.insert(one.topic);
  ordered_json topics = ordered_json::array();
  for (const auto& [topic, its] : by_topic) {
    const auto counts = traffic.find(topic);
    const bus::TopicTraffic sum = counts == traffic.end() ? bus::TopicTraffic{} : counts->second;
    ordered_json told = ordered_json::array();
    for (const bus::Endpoint* one : its) told.push_back(EndpointJson(*one));
    topics.push_back({{"topic", topic},
                      {"sent", sum.sent},
                      {"received", sum.received},
                      {"endpoints", told},
                      {"mismatches", MismatchesJson(its)},
                      {"unserved", unserved.contains(topic) ? wire::WhoWouldSend(topic) : ""}});
  }
  return {{"at", at}, {"topics", topics}};
}

HttpReply BusView::Get(std::chrono::nanoseconds now) {
  if (participant_ == nullptr) return ErrorReply(404, "this robot is on no bus");
  if (text_.empty() || now >= made_ + kFresh) {
    try {
      // Made anew each time: discovery gives a new reader all it knows, and one that nobody polls
      // would gather every endpoint that comes and goes.
      bus::EndpointSurvey survey(*participant_, bus::SurveyOf::kAll);
      survey.Poll();
      std::vector<bus::Endpoint> endpoints = survey.endpoints();
      for (bus::Endpoint& one : endpoints) {
        const MessageType* const type = one.ours ? FindMessageType(one.who.type) : nullptr;
        if (type != nullptr) one.definition = bus::DefinitionOf(*type->descriptor);
      }
      text_ = JsonText(BusJson(endpoints, participant_->traffic().Read(),
                               std::chrono::duration<double>(now).count())) +
              "\n";
    } catch (const BusError& error) {
      return ErrorReply(503, error.what());
    }
    made_ = now;
  }
  return {.body = text_};
}

}  // namespace understudy::server
