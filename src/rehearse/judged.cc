#include "rehearse/judged.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <utility>

#include "base/printed.h"

namespace understudy::rehearse {
namespace {

using judge::Outcome;
using judge::Reason;
using judge::Verdict;

// Half the width of a closeup [s]; *assumed*.
constexpr double kCloseup = 0.5;

// The log time of step 0; of another's recording its first message.
std::uint64_t StartOf(const record::McapContents& contents) {
  std::uint64_t start = contents.first_time;
  const auto about = contents.metadata.find("understudy");
  if (about == contents.metadata.end()) return start;
  const auto text = about->second.find("start_time_ns");
  if (text == about->second.end()) return start;
  std::from_chars(text->second.data(), text->second.data() + text->second.size(), start);
  return std::min(start, contents.first_time);
}

std::string TypeOf(const record::RecordingReader& reader, const record::McapChannel& channel) {
  const record::McapSchema* schema = reader.SchemaOf(channel);
  return schema == nullptr ? "" : schema->name;
}

// Adds a value that is kept until the next sample, as two points.
void AddStep(double at, double value, record::TracePoints* points) {
  if (!std::isfinite(value)) return;
  if (!points->empty() && points->back().second != value) {
    points->emplace_back(at, points->back().second);
  }
  points->emplace_back(at, value);
}

// Collects the values of all signals, and those around the deciding instants.
void Draw(const Recordings& recordings, const Expectations& expectations, Judged* judged) {
  std::vector<record::Trace> traces(expectations.signals.size());
  judged->closeups.resize(expectations.list.size());
  for (std::size_t i = 0; i < expectations.list.size(); ++i) {
    const double at = SecondsOf(judged->rulings[i].verdict.worth.at);
    judged->closeups[i].assign(
        expectations.list[i].signals.size(),
        {.from = std::max(0.0, at - kCloseup), .to = std::min(judged->end, at + kCloseup)});
  }
  std::vector<double> before(expectations.signals.size(), judge::kUnknown);
  const auto give = [&](judge::Time time, std::span<const double> values) {
    const double at = SecondsOf(time);
    for (std::size_t i = 0; i < values.size(); ++i) {
      // A change is a step. Where nothing changes one point in a while is enough.
      if (values[i] != before[i] && std::isfinite(before[i])) {
        traces[i].Add(at, before[i], 0, judged->end);
      }
      traces[i].Add(at, values[i], 0, judged->end);
      before[i] = values[i];
    }
    for (std::size_t i = 0; i < expectations.list.size(); ++i) {
      const std::vector<std::size_t>& signals = expectations.list[i].signals;
      for (std::size_t j = 0; j < signals.size(); ++j) {
        Closeup& closeup = judged->closeups[i][j];
        if (at < closeup.from || at > closeup.to) continue;
        AddStep(at, values[signals[j]], &closeup.points);
      }
    }
  };
  WorldEvidence evidence(expectations.signals, expectations.robots, give);
  for (std::size_t robot = 0; robot < recordings.size(); ++robot) {
    const record::RecordingReader& reader = *recordings[robot];
    evidence.Begin(robot, StartOf(reader.contents()));
    reader.ReadMessages(
        [&](const record::McapChannel& channel, const record::McapMessage& message) {
          evidence.Take(robot, channel, TypeOf(reader, channel), message);
          return true;
        });
  }
  evidence.Finish();
  for (const record::Trace& trace : traces) {
    judged->whole.push_back(record::Thinned(trace.points(), 0, judged->end));
  }
}

std::string WithUnit(double number, const std::string& unit) {
  return NumberText(number) + (unit.empty() ? "" : " " + unit);
}

std::string AtText(judge::Time time) { return Printed(" at %.3f s", SecondsOf(time)); }

// Whether it must hold at all instants of a window, or else at one.
bool HoldsThroughout(const judge::Claim& claim) {
  return !claim.until && claim.op != judge::Operator::kEventually &&
         claim.op != judge::Operator::kStays;
}

// Why there is no verdict, by Reason.
std::string ReasonText(const Expectations& expectations, const Expectation& expectation,
                       const Verdict& verdict, judge::Time end) {
  const std::string ended = "the evidence ends" + AtText(end);
  switch (verdict.reason) {
    case Reason::kNeverBegan:
      return "its window never began";
    case Reason::kEndedBefore:
      return ended + ", before its window begins";
    case Reason::kEndedWithin:
      return ended + ", before its window does";
    case Reason::kNothingSaid: {
      std::string names;
      for (const std::size_t signal : expectation.signals) {
        names += (names.empty() ? "" : ", ") + expectations.signals[signal].name;
      }
      return "nothing in its window says " + names;
    }
    case Reason::kNone:
      break;
  }
  return {};
}

void AddFailures(const Expectations& expectations, Judged* judged) {
  std::size_t refused = 0;
  for (const Evidence::Told& told : judged->events) {
    if (!expectations.script || told.event.kind != "script_refused") continue;
    if (++refused == 1) {
      const std::string text = Printable(told.event.text);  // "script: walk.yaml:7: it falls"
      judged->failures.push_back(
          {"the script", "was refused" + text.substr(std::min(text.find(':'), text.size()))});
    }
  }
  if (refused > 1) {
    judged->failures.back().why += ", and " + std::to_string(refused - 1) + " more";
  }
  for (std::size_t robot = 0; robot < judged->damage.size(); ++robot) {
    if (!expectations.safe || !judged->damage[robot]) continue;
    const std::string beyond = BeyondText(*judged->damage[robot]);
    if (beyond.empty()) continue;
    judged->failures.push_back(
        {expectations.robots.empty() ? "the robot" : expectations.robots[robot],
         "is beyond its limits: " + beyond});
  }
}

}  // namespace

Jury::Jury(const Expectations& expectations)
    : expectations_(expectations),
      judge_(expectations.claims()),
      evidence_(expectations.signals, expectations.robots,
                [this](judge::Time at, std::span<const double> values) {
                  judge_.Take(at, values);
                  failed_ = judge_.failed();
                  decided_ = judge_.decided();
                }) {
  const std::size_t robots = std::max<std::size_t>(1, expectations.robots.size());
  for (std::size_t robot = 0; robot < robots; ++robot) hearings_.emplace_back(robot, this);
}

void Jury::Finish(bool cut) {
  evidence_.Finish();
  judge_.Finish(cut);
}

std::vector<Verdict> Jury::verdicts() const {
  std::vector<Verdict> verdicts;
  for (std::size_t i = 0; i < expectations_.list.size(); ++i) {
    Verdict verdict = judge_.verdict(i);
    if (!WhyNot(i).empty()) verdict = {.outcome = Outcome::kNotJudged};
    // No message at all.
    if (verdict.outcome == Outcome::kUndecided) {
      verdict = {.outcome = Outcome::kNotJudged, .reason = Reason::kEndedBefore};
    }
    verdicts.push_back(verdict);
  }
  return verdicts;
}

std::string Jury::WhyNot(std::size_t expectation) const {
  for (const std::size_t signal : expectations_.list[expectation].signals) {
    if (std::string why = evidence_.WhyUnknown(signal); !why.empty()) return why;
  }
  return {};
}

std::size_t Judged::Count(Outcome outcome) const {
  return static_cast<std::size_t>(std::ranges::count_if(
      rulings, [outcome](const Ruling& ruling) { return ruling.verdict.outcome == outcome; }));
}

Recordings OpenRecordings(const std::vector<std::filesystem::path>& files) {
  Recordings recordings;
  for (const std::filesystem::path& file : files) recordings.push_back(record::OpenRecording(file));
  return recordings;
}

Judged JudgeRecordings(const Recordings& recordings, const Expectations& expectations, bool cut) {
  Jury jury(expectations);
  Judged judged;
  for (std::size_t robot = 0; robot < recordings.size(); ++robot) {
    const record::RecordingReader& reader = *recordings[robot];
    record::Audience& hearing = *jury.Hearing(robot);
    std::optional<record::Damage>& damage = judged.damage.emplace_back();
    hearing.Begin(StartOf(reader.contents()));
    reader.ReadMessages(
        [&](const record::McapChannel& channel, const record::McapMessage& message) {
          hearing.Hear(channel, TypeOf(reader, channel), message);
          if (channel.topic == record::kDamageTopic) damage = record::DecodeDamage(message.data);
          return true;
        });
    if (judged.cut_short.empty()) judged.cut_short = reader.contents().cut_short;
  }
  jury.Finish(cut);
  judged.events = jury.events();
  judged.end = SecondsOf(jury.end());
  const auto& metadata = recordings.front()->contents().metadata;
  if (const auto about = metadata.find("understudy"); about != metadata.end()) {
    judged.about = about->second;
  }
  const std::vector<Verdict> verdicts = jury.verdicts();
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    std::string why = jury.WhyNot(i);
    if (why.empty()) {
      why = ReasonText(expectations, expectations.list[i], verdicts[i], jury.end());
    }
    judged.rulings.push_back({.verdict = verdicts[i], .why = std::move(why)});
  }
  AddFailures(expectations, &judged);
  Draw(recordings, expectations, &judged);
  return judged;
}

std::optional<Outcome> OutcomeOf(std::size_t robot, const Expectations& expectations,
                                 const Judged& judged) {
  std::optional<Outcome> worst;
  const std::string name = expectations.robots[robot] + ":";
  for (std::size_t i = 0; i < expectations.list.size(); ++i) {
    const bool about = std::ranges::any_of(expectations.list[i].signals, [&](std::size_t signal) {
      return expectations.signals[signal].name.starts_with(name);
    });
    if (!about || worst == Outcome::kFailed) continue;
    const Outcome outcome = judged.rulings[i].verdict.outcome;
    if (!worst || outcome != Outcome::kPassed) worst = outcome;
  }
  return worst;
}

std::string MarginText(const Expectation& expectation, const Verdict& verdict) {
  const double margin = verdict.worth.margin;
  if (verdict.reason != Reason::kNone || !std::isfinite(margin)) return {};
  if (expectation.claim.op == judge::Operator::kCount) {
    return NumberText(margin) + (std::abs(margin) == 1 ? " time" : " times");
  }
  return WithUnit(margin + 0.0, expectation.LeafOf(verdict).unit);
}

std::string Explain(const Expectation& expectation, const Ruling& ruling) {
  const Verdict& verdict = ruling.verdict;
  if (!ruling.why.empty()) return ruling.why;
  if (expectation.claim.op == judge::Operator::kCount) {
    return NumberText(verdict.worth.value) + (verdict.worth.value == 1 ? " time" : " times") +
           ", the last" + AtText(verdict.worth.at);
  }
  const LeafText& leaf = expectation.LeafOf(verdict);
  const bool passed = verdict.outcome == Outcome::kPassed;
  std::string text;
  if (std::isfinite(verdict.worth.margin)) {
    text = leaf.text.substr(0, leaf.text.find(' ')) + " was " +
           WithUnit(verdict.worth.value, leaf.unit);
  } else if (passed ? HoldsThroughout(expectation.claim) : !HoldsThroughout(expectation.claim)) {
    return passed ? "throughout" : "never happened";
  } else {
    // An event or a state.
    const bool met =
        judge::Holds(judge::MarginOf(leaf.leaf, verdict.worth.value / leaf.leaf.scale));
    const bool tells = !met && leaf.is_number && !std::isnan(verdict.worth.value);
    text =
        tells ? leaf.text.substr(0, leaf.text.find(' ')) + " was " + NumberText(verdict.worth.value)
              : (met ? "" : "not ") + leaf.text;
  }
  text += AtText(verdict.worth.at);
  if (verdict.came_true && verdict.outcome == Outcome::kPassed) {
    const bool settles = expectation.claim.op == judge::Operator::kSettles;
    text += settles ? ", settled" : ", came true";
    text += AtText(*verdict.came_true);
  }
  return text;
}

std::string NumberText(double number) { return Printed("%.4g", number); }

}  // namespace understudy::rehearse
