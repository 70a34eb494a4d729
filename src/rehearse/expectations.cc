#include "rehearse/expectations.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "rehearse/yaml_values.h"

namespace understudy::rehearse {
namespace {

using judge::Claim;
using judge::Formula;
using judge::OperatorRow;
using schema::YamlValue;

constexpr std::string_view kSafe = "safe";
constexpr std::size_t kMostName = 80;  // characters; *assumed*
constexpr std::size_t kMostSays = 400;

judge::Time TimeOf(double seconds) { return static_cast<judge::Time>(std::llround(seconds * 1e9)); }

judge::Time Time(const YamlValue& value, const std::string& key) {
  return TimeOf(SecondsOf(value, key));
}

// Makes formulas of conditions and collects the signals that they need.
class Binder {
 public:
  Binder(const Names& names, Expectations* all, Expectation* one)
      : names_(names), all_(all), one_(one) {}

  Formula Bind(const YamlValue& value, const std::string& key, std::vector<LeafText>* leaves) {
    if (value.kind != YamlValue::Kind::kScalar) {
      Refuse(value, key, "a condition, as in base.height > 0.3");
    }
    auto bound = signals::BindCondition(value.text, names_, &all_->signals);
    if (!bound) throw ConfigError(value.where + ": " + key + ": " + bound.why());
    for (const LeafText& leaf : bound->leaves) {
      std::vector<std::size_t>& needed = one_->signals;
      const auto place = std::ranges::lower_bound(needed, leaf.signal);
      if (place == needed.end() || *place != leaf.signal) needed.insert(place, leaf.signal);
    }
    *leaves = std::move(bound->leaves);
    return std::move(bound->formula);
  }

 private:
  const Names& names_;
  Expectations* all_;
  Expectation* one_;
};

struct ExpectationKey {
  std::string_view key;
  bool OperatorRow::*taken_by;  // null: by all
  std::string_view takes, says;
};
constexpr ExpectationKey kExpectationKeys[] = {
    {"name", nullptr, "a text", "In the report; operator and condition unless given"},
    {"says", nullptr, "a sentence", "What it means, for people"},
    {"from", nullptr, "seconds or a condition",
     "Beginning of the window: simulated time, or the first instant at which the condition holds; "
     "the start unless given"},
    {"to", nullptr, "seconds or a condition",
     "End of the window: simulated time, or the first instant at which the condition holds; the "
     "end of the run unless given"},
    {"during", nullptr, "seconds", "Length of the window, in place of `to`"},
    {"until", &OperatorRow::takes_until, "a condition", "What the claim holds until"},
    {"within", &OperatorRow::takes_within, "seconds", "After the window begins, at the latest"},
    {"for", &OperatorRow::takes_for, "seconds", "For so long; needed"},
    {"least", &OperatorRow::takes_bounds, "a number", "Times, at least; 0 unless given"},
    {"most", &OperatorRow::takes_bounds, "a number", "Times, at most"},
};

std::vector<std::string> KeysOf(const OperatorRow* row) {
  std::vector<std::string> keys;
  for (const ExpectationKey& key : kExpectationKeys) {
    if (key.taken_by == nullptr || row == nullptr || row->*key.taken_by) keys.emplace_back(key.key);
  }
  for (const OperatorRow& each : judge::Operators()) {
    if (row == nullptr || &each == row) keys.emplace_back(each.word);
  }
  return keys;
}

// The operator of an expectation: the one key that is its word.
const OperatorRow& OperatorOf(const YamlValue& value) {
  const OperatorRow* found = nullptr;
  for (const YamlValue& key : value.keys) {
    const auto row = std::ranges::find(judge::Operators(), key.text, &OperatorRow::word);
    if (row == judge::Operators().end()) continue;
    if (found != nullptr) {
      throw ConfigError(key.where + ": one expectation cannot be both " + std::string(found->word) +
                        " and " + key.text);
    }
    found = &*row;
  }
  const std::vector<std::string> known = KeysOf(found);
  for (const YamlValue& key : value.keys) {
    if (std::ranges::find(known, key.text) != known.end()) continue;
    const bool elsewhere =
        found != nullptr && std::ranges::find(kExpectationKeys, key.text, &ExpectationKey::key) !=
                                std::ranges::end(kExpectationKeys);
    throw ConfigError(key.where + ": key '" + schema::OneLine(key.text) +
                      "': " + (elsewhere ? "not with " + std::string(found->word) : "unknown") +
                      DidYouMean(key.text, known));
  }
  if (found == nullptr) {
    std::string words;
    for (const OperatorRow& row : judge::Operators()) {
      words += (words.empty() ? "" : ", ") + std::string(row.word);
    }
    throw ConfigError(value.where + ": an expectation needs one of " + words);
  }
  return *found;
}

// Reads one end of the window.
judge::Edge EdgeOf(const YamlValue& value, const std::string& key, Binder* binder) {
  if (NumberOf(value)) return {.at = Time(value, key)};
  std::vector<LeafText> leaves;
  return {.when = binder->Bind(value, key, &leaves)};
}

std::string Asked(const YamlValue& value, const OperatorRow& row) {
  const std::string word(row.word);
  std::string text = word + " " + value.Find(word)->text;
  constexpr std::string_view kTold[] = {"until", "within", "for", "least",
                                        "most",  "from",   "to",  "during"};
  for (const std::string_view key : kTold) {
    const YamlValue* given = value.Find(key);
    if (given == nullptr) continue;
    const bool seconds = key != "least" && key != "most" && NumberOf(*given);
    text += ", " + std::string(key) + " " + given->text + (seconds ? " s" : "");
  }
  return text;
}

Expectation ReadOne(const YamlValue& value, const Names& names, Expectations* all) {
  if (value.kind != YamlValue::Kind::kMap) {
    Refuse(value, "expect", "an expectation, as in {always: base.height > 0.2}");
  }
  const OperatorRow& row = OperatorOf(value);
  const std::string word(row.word);
  Expectation one{.name = {}, .where = value.where};
  Binder binder(names, all, &one);
  Claim& claim = one.claim;
  claim.op = row.op;
  claim.formula = binder.Bind(*value.Find(word), word, &one.leaves);
  // The window.
  if (const YamlValue* from = value.Find("from")) claim.from = EdgeOf(*from, "from", &binder);
  if (const YamlValue* to = value.Find("to")) claim.to = EdgeOf(*to, "to", &binder);
  if (const YamlValue* during = value.Find("during")) {
    if (claim.to.given()) {
      throw ConfigError(during->where + ": during: the window already ends with `to`");
    }
    claim.length = Time(*during, "during");
  }
  if (claim.from.at && claim.to.at && *claim.to.at < *claim.from.at) {
    throw ConfigError(value.Find("to")->where + ": to: the window ends before it begins");
  }
  // What only some operators take.
  if (const YamlValue* until = value.Find("until")) {
    claim.until = binder.Bind(*until, "until", &one.until_leaves);
  }
  if (const YamlValue* within = value.Find("within")) claim.within = Time(*within, "within");
  if (claim.op == judge::Operator::kAlways && claim.within && !claim.until) {
    throw ConfigError(value.Find("within")->where + ": within: with always only beside until");
  }
  if (row.takes_for) {
    const YamlValue* hold = value.Find("for");
    if (hold == nullptr) throw ConfigError(value.where + ": for: missing; expected seconds");
    claim.hold = Time(*hold, "for");
  }
  if (row.takes_bounds) {
    const auto bound = [&value](const char* key, double* to) {
      const YamlValue* given = value.Find(key);
      if (given == nullptr) return false;
      const auto number = NumberOf(*given);
      if (!number || *number < 0) Refuse(*given, key, "a number of times, at least 0");
      *to = *number;
      return true;
    };
    const bool least = bound("least", &claim.least), most = bound("most", &claim.most);
    if (!least && !most) throw ConfigError(value.where + ": count needs least, most or both");
    if (claim.most < claim.least) throw ConfigError(value.where + ": most is less than least");
  }
  // What it is called.
  one.asks = Asked(value, row);
  const YamlValue* name = value.Find("name");
  one.name = name == nullptr ? one.asks : LineOf(*name, "name", kMostName);
  if (const YamlValue* says = value.Find("says")) one.says = LineOf(*says, "says", kMostSays);
  return one;
}

// What `safe` stands for, besides the damage sheet, of the robot whose signals begin with `prefix`.
// The angle is *assumed*: a robot that lies or climbs tilts less.
YamlValue SafeSet(const std::string& prefix) {
  const auto line = [&prefix](const std::string& condition, const std::string& name) {
    return "- {never: \"" + prefix + condition + "\", name: \"" + prefix + name + "\"}\n";
  };
  return schema::ParseYaml(line("base.tilt > 45 deg", "stays upright") +
                               line("refused happens", "no command is refused") +
                               line("call_refused happens", "no call is refused"),
                           std::string(kSafe));
}

}  // namespace

std::vector<Claim> Expectations::claims() const {
  std::vector<Claim> claims;
  for (const Expectation& one : list) claims.push_back(one.claim);
  return claims;
}

Expectations ReadExpectations(const YamlValue& list, const Names& names) {
  if (list.kind != YamlValue::Kind::kSequence || list.items.empty()) {
    Refuse(list, "expect", "a list of expectations, as in [{always: base.height > 0.2}]");
  }
  Expectations all;
  if (!names.robot.empty()) {
    all.robots.push_back(names.robot);
    for (const Names& other : names.others) all.robots.push_back(other.robot);
  }
  std::vector<YamlValue> items;
  for (const YamlValue& item : list.items) {
    if (item.kind != YamlValue::Kind::kScalar || item.text != kSafe) {
      items.push_back(item);
      continue;
    }
    all.safe = true;
    std::vector<std::string> prefixes{all.robots.empty() ? "" : names.robot + ":"};
    for (const Names& other : names.others) prefixes.push_back(other.robot + ":");
    for (const std::string& prefix : prefixes) {
      YamlValue set = SafeSet(prefix);
      for (YamlValue& one : set.items) {
        one.where = item.where;
        items.push_back(std::move(one));
      }
    }
  }
  for (const YamlValue& item : items) {
    Expectation one = ReadOne(item, names, &all);
    const auto same = std::ranges::find(all.list, one.name, &Expectation::name);
    if (same != all.list.end()) {
      throw ConfigError(item.where + ": name: '" + one.name + "' is the name of that at " +
                        same->where);
    }
    all.list.push_back(std::move(one));
  }
  return all;
}

std::string ExpectationsReference() {
  std::string text = "| word | claims | signal temporal logic |\n|---|---|---|\n";
  for (const OperatorRow& row : judge::Operators()) {
    text += "| `" + std::string(row.word) + "` | " + std::string(row.says) + " | `" +
            std::string(row.formula) + "` |\n";
  }
  text += "\n| key | with | takes | is |\n|---|---|---|---|\n";
  for (const ExpectationKey& key : kExpectationKeys) {
    std::string with;
    for (const OperatorRow& row : judge::Operators()) {
      if (key.taken_by == nullptr || !(row.*key.taken_by)) continue;
      with += (with.empty() ? "`" : ", `") + std::string(row.word) + "`";
    }
    text += "| `" + std::string(key.key) + "` | " + (with.empty() ? "all" : with) + " | " +
            std::string(key.takes) + " | " + std::string(key.says) + " |\n";
  }
  return text;
}

}  // namespace understudy::rehearse
