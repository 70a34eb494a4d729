// Who is in the domain, and whether they match the vendor's.
#include "base/nearest_word.h"
#include "doctor/echo_topics.h"
#include "doctor/findings.h"
#include "robot/command_topics.h"
#include "wire/robot_topics.h"
#include "wire/unserved.h"
#include "wire/who_serves.h"

namespace understudy::doctor {
namespace {

Finding Domain(const Measurements& seen) {
  if (!seen.no_bus.empty()) {
    return Wrong(seen.no_bus, "put right what is wrong above, or choose another --domain");
  }
  const std::string joined =
      fmt::format("joined domain {} on {}", seen.question.domain, seen.question.interface);
  std::vector<std::string> who;
  for (const bus::Neighbour& one : seen.participants) who.push_back(bus::Describe(one));
  const auto count = static_cast<double>(who.size());
  if (who.empty()) return With(Ok(joined + ", alone"), {{"participants", count}});
  return With(Ok(fmt::format("{}, with {}: {}", joined, who.size(), Listed(who))),
              {{"participants", count}});
}

Finding Robots(const Measurements& seen) {
  if (!seen.no_bus.empty()) return NotSeen(kNoBus);
  std::vector<std::string> speaking, silent;
  for (const StateWriter& one : seen.robots) (one.speaks ? speaking : silent).push_back(one.who);
  const std::size_t count = speaking.size();
  const std::string told =
      count == 0 ? "no robot publishes"
                 : fmt::format("{} publishes rt/lowstate: {}", count, Listed(speaking));
  const Figures figures = {{"speaking", static_cast<double>(count)},
                           {"silent", static_cast<double>(silent.size())}};
  const std::optional<int>& wanted = seen.question.robots;
  if (count > 1 && !wanted) {
    return With(Wrong(told + ": a program that reads both obeys neither",
                      "switch all but one off, or move them to other domains"),
                figures);
  }
  if (wanted && std::cmp_not_equal(*wanted, count)) {
    return With(Wrong(fmt::format("{}; expected {}", told, *wanted),
                      std::cmp_less(*wanted, count)
                          ? "switch the others off, or choose another --domain or --interface"
                          : "switch it on, and wait until it has started; then look at the rows "
                            "above"),
                figures);
  }
  if (count == 1 && !wanted) {
    return With(Warning(told + "; a simulated one would not start beside it",
                        "say with --robots 1 that it is wanted, or with --robots 0 that it is not"),
                figures);
  }
  if (!silent.empty()) {
    return With(Warning(told + ", and " + Listed(silent) + " has a silent writer of rt/lowstate",
                        "start a simulated robot before it, or with --set guard.on_stranger=warn"),
                figures);
  }
  return With(Ok(told), figures);
}

Finding RobotStates(const Measurements& seen) {
  const States& states = seen.states;
  if (!seen.no_bus.empty()) return NotSeen(kNoBus);
  if (states.count < 2) return NotSeen("no robot publishes");
  const std::string text = fmt::format("rt/lowstate at {:.0f} Hz, {} at most between two",
                                       states.rate, Ms(states.longest_pause));
  const Figures figures = {{"rate", states.rate}, {"longest_pause", states.longest_pause}};
  if (states.longest_pause > kTenPeriods) {
    return With(Warning(text,
                        "see wakings, load and dropped of this machine, and the same on the "
                        "robot's"),
                figures);
  }
  return With(Ok(text), figures);
}

std::string Whose(const bus::Endpoint& endpoint) {
  const bus::Neighbour brief{
      .host = endpoint.who.host, .process = endpoint.who.process, .pid = endpoint.who.pid};
  return endpoint.topic + ": " + bus::Describe(brief) + (endpoint.writes ? " writes" : " reads");
}

bool IsOf(const std::vector<std::string_view>& types, const std::string& type) {
  return std::ranges::find(types, type) != types.end();
}

// The family whose type that is; "" for a type of both or of none.
std::string_view FamilyOf(std::string_view type) {
  if (type.starts_with("unitree_go::")) return "go";
  if (type.starts_with("unitree_hg::")) return "hg";
  return "";
}

// The family of the one who writes rt/lowstate, "" if there is none, or if they differ.
std::string_view FamilyHere(const Measurements& seen) {
  std::string_view family;
  for (const bus::Endpoint& one : seen.endpoints) {
    if (one.topic != wire::kLowStateName || !one.writes) continue;
    const std::string_view its = FamilyOf(one.who.type);
    if (!family.empty() && its != family) return "";
    family = its;
  }
  return family;
}

// Whether a participant reads rt/lowstate of that family, too: a robot of this program listens for
// others of both.
bool HearsFamily(const Measurements& seen, const bus::ParticipantKey& who,
                 std::string_view family) {
  return std::ranges::any_of(seen.endpoints, [&](const bus::Endpoint& one) {
    return one.topic == wire::kLowStateName && !one.writes && one.who.participant == who &&
           FamilyOf(one.who.type) == family;
  });
}

// What is wrong with its topic and type; "" if nothing is.
std::string WhyNotType(const Measurements& seen, const bus::Endpoint& one,
                       std::string_view family) {
  const std::vector<std::string_view> types = wire::TypesOf(one.topic);
  if (types.empty()) {
    const bool low = one.writes && one.who.type.ends_with("::LowCmd_") && !IsEchoTopic(one.topic);
    if (!low) return "";
    std::vector<std::string> known;
    for (const wire::TopicName& topic : wire::VendorTopics()) known.emplace_back(topic.name);
    const std::string near = NearestWord(one.topic, known);
    return " a LowCmd_ that no robot reads" + (near.empty() ? "" : "; is " + near + " meant?");
  }
  if (!IsOf(types, one.who.type)) {
    std::string expected;
    for (const std::string_view type : types) {
      expected += (expected.empty() ? "" : " or ") + std::string(type);
    }
    return " " + one.who.type + " instead of " + expected;
  }
  const std::string_view its = FamilyOf(one.who.type);
  const bool deaf = one.topic == wire::kLowStateName && !one.writes &&
                    !HearsFamily(seen, one.who.participant, family);
  if ((robot::IsBodyCommandTopic(one.topic) || deaf) && !family.empty() && its != family) {
    return fmt::format(" the {} type, and the robot here is of {}", its, family);
  }
  return "";
}

Finding Types(const Measurements& seen) {
  if (!seen.no_bus.empty()) return NotSeen(kNoBus);
  const std::string_view family = FamilyHere(seen);
  std::vector<std::string> bad;
  std::size_t known = 0;
  for (const bus::Endpoint& one : seen.endpoints) {
    if (!wire::TypesOf(one.topic).empty()) ++known;
    if (const std::string why = WhyNotType(seen, one, family); !why.empty()) {
      bad.push_back(Whose(one) + why);
    }
  }
  const Figures figures = {{"endpoints", static_cast<double>(known)},
                           {"mismatched", static_cast<double>(bad.size())}};
  if (bad.empty()) {
    return With(
        Ok(fmt::format("{} readers and writers of the vendor's topics, all of its types", known)),
        figures);
  }
  return With(Wrong(Listed(bad, "; "),
                    "build the program with the vendor's IDL, of the robot's family (go or hg)"),
              figures);
}

// Why an endpoint of the vendor's topic and type does not match the vendor's
// (docs/dev/sources.md#dds);
// "" if it does.
std::string WhyNotQos(const bus::Endpoint& one) {
  if (!one.partitions.empty()) return "partition " + one.partitions;
  if (one.exclusive) return "exclusive ownership";
  if (one.writes) return "";
  if (one.keeps_for_late) return "durability above volatile";
  if (one.has_deadline) return "a deadline";
  if (!one.xcdr1) return "no XCDR1 among its representations";
  return "";
}

Finding Quality(const Measurements& seen) {
  if (!seen.no_bus.empty()) return NotSeen(kNoBus);
  std::vector<std::string> bad, poor;
  for (const bus::Endpoint& one : seen.endpoints) {
    if (!IsOf(wire::TypesOf(one.topic), one.who.type)) continue;
    if (const std::string why = WhyNotQos(one); !why.empty()) {
      bad.push_back(Whose(one) + " with " + why);
    } else if (one.writes && !one.reliable) {
      poor.push_back(Whose(one) + " as best effort");
    }
  }
  const Figures figures = {{"unmatched", static_cast<double>(bad.size())},
                           {"best_effort_writers", static_cast<double>(poor.size())}};
  if (!bad.empty()) {
    return With(Wrong(Listed(bad, "; ") + ": nothing passes between it and the vendor's",
                      "use the vendor's: volatile, shared, no partition, no deadline, XCDR1"),
                figures);
  }
  if (!poor.empty()) {
    return With(Warning(Listed(poor, "; ") + ": no reliable reader, such as ROS 2's, receives it",
                        "make the writer reliable, as the vendor's are"),
                figures);
  }
  return With(Ok("the quality of service of all others matches the vendor's"), figures);
}

Finding Served(const Measurements& seen) {
  if (!seen.no_bus.empty()) return NotSeen(kNoBus);
  std::vector<std::string> waits;
  for (const wire::Unserved& one : wire::UnservedIn(seen.endpoints)) {
    const bus::Endpoint endpoint{.topic = one.topic, .writes = !one.reads, .who = one.who};
    waits.push_back(Whose(endpoint) + " (served by " + wire::WhoWouldSend(one.topic) + ")");
  }
  const Figures figures = {{"unserved", static_cast<double>(waits.size())}};
  if (waits.empty()) return With(Ok("each topic that is read is written"), figures);
  return With(Warning(Listed(waits, "; ") + ": nobody here serves that",
                      "start what serves it, or do without it"),
              figures);
}

constexpr Check kDomainChecks[] = {
    {"domain", "can it be joined, and who is on it", Domain},
    {"robots", "who writes rt/lowstate, and who only could", Robots},
    {"states", "rate and longest pause of rt/lowstate", RobotStates},
    {"types", "are the vendor's topics read and written in the vendor's types", Types},
    {"quality", "does the quality of service of others match the vendor's", Quality},
    {"served", "is there somebody for each topic that others read, or write to robots", Served},
};

}  // namespace

std::span<const Check> DomainChecks() { return kDomainChecks; }

}  // namespace understudy::doctor
