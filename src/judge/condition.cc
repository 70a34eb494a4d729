#include "judge/condition.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>

namespace understudy::judge {
namespace {

constexpr std::size_t kLongest = 1000;      // characters; *assumed*
constexpr std::size_t kLongestPrint = 100;  // bytes, which an event has room for; *assumed*
constexpr int kDeepest = 16;                // parentheses and nots; *assumed*

struct RelationRow {
  std::string_view word;
  Relation relation;
};
constexpr RelationRow kNumeric[] = {{"<", Relation::kBelow},
                                    {"<=", Relation::kAtMost},
                                    {">", Relation::kAbove},
                                    {">=", Relation::kAtLeast}};
constexpr RelationRow kOccurring[] = {{"happens", Relation::kHappens},
                                      {"arrives", Relation::kArrives}};

bool IsSpace(char c) { return c == ' ' || c == '\t' || c == '\n'; }
bool IsOperator(char c) { return c == '<' || c == '>' || c == '='; }

// Cuts a text into words. "gap(rt/lowcmd)" is one word, and what stands between double quotes, with
// these; "(" and ")" elsewhere are words.
std::vector<std::string_view> Cut(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = at;
    if (IsSpace(text[at])) {
      ++at;
      continue;
    }
    if (text[at] == '(' || text[at] == ')') {
      ++at;
    } else if (text[at] == '"') {
      at = std::min(text.find('"', at + 1), text.size() - 1) + 1;
    } else if (IsOperator(text[at])) {
      while (at < text.size() && IsOperator(text[at])) ++at;
    } else {
      int open = 0;
      for (; at < text.size() && !IsSpace(text[at]) && !IsOperator(text[at]); ++at) {
        if (text[at] == '(') ++open;
        if (text[at] == ')' && --open < 0) break;
      }
    }
    words.push_back(text.substr(begin, at - begin));
  }
  return words;
}

std::optional<double> NumberOf(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double number = 0;
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, number);
  if (error != std::errc() || stop != end || !std::isfinite(number)) return std::nullopt;
  return number;
}

bool IsUnit(std::string_view word) { return word != "and" && word != "or" && word != ")"; }

std::string NumberText(double number) {
  std::string digits(32, '\0');
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  digits.resize(static_cast<std::size_t>(end - digits.data()));
  return digits;
}

class ConditionReader {
 public:
  explicit ConditionReader(std::string_view text) : words_(Cut(text)) {}

  Result<Condition> Read() {
    Result<Condition> condition = Any(0);
    if (condition && at_ < words_.size()) return Expected("'and', 'or' or the end");
    return condition;
  }

 private:
  using Reading = Result<Condition> (ConditionReader::*)(int depth);

  Result<Condition> Any(int depth) {
    return Joined("or", Condition::Kind::kAny, &ConditionReader::All, depth);
  }
  Result<Condition> All(int depth) {
    return Joined("and", Condition::Kind::kAll, &ConditionReader::One, depth);
  }

  Result<Condition> Joined(std::string_view word, Condition::Kind kind, Reading part, int depth) {
    Condition joined{.kind = kind};
    do {
      Result<Condition> next = (this->*part)(depth);
      if (!next) return next;
      joined.parts.push_back(*std::move(next));
    } while (Takes(word));
    return joined.parts.size() == 1 ? std::move(joined.parts.front()) : std::move(joined);
  }

  Result<Condition> One(int depth) {
    if (depth > kDeepest) return Error{"it is nested too deeply"};
    if (Takes("not")) {
      Result<Condition> inner = One(depth + 1);
      if (!inner) return inner;
      return Not(*std::move(inner));
    }
    if (Takes("(")) {
      Result<Condition> inner = Any(depth + 1);
      if (inner && !Takes(")")) return Expected("')'");
      return inner;
    }
    return Compared();
  }

  // A comparison.
  Result<Condition> Compared() {
    if (at_ == words_.size() || NumberOf(Now()) || IsOperator(Now().front()) || Now() == ")") {
      return Expected("a signal, an event or a topic");
    }
    Comparison comparison{.subject = std::string(words_[at_++])};
    if (comparison.subject == "the") return Printed();
    for (const RelationRow& row : kOccurring) {
      if (!Takes(row.word)) continue;
      comparison.relation = row.relation;
      return Condition{.comparison = std::move(comparison)};
    }
    for (const RelationRow& row : kNumeric) {
      if (!Takes(row.word)) continue;
      comparison.relation = row.relation;
      const auto number = TakeNumber();
      if (!number) return Expected("a number");
      comparison.number = *number;
      TakeUnit(&comparison);
      return Condition{.comparison = std::move(comparison)};
    }
    if (Takes("between")) return Between(std::move(comparison));
    if (Takes("is")) return Is(std::move(comparison));
    return Expected("one of < <= > >= is between happens arrives");
  }

  // What follows "the".
  Result<Condition> Printed() {
    if (!Takes("program")) return Expected("'program'");
    if (!Takes("prints")) return Expected("'prints'");
    const std::string_view text = at_ < words_.size() ? Now() : "";
    if (text.size() < 3 || !text.starts_with('"') || !text.ends_with('"')) {
      return Expected("a text between double quotes");
    }
    if (text.size() - 2 > kLongestPrint) {
      return Error{"a text has at most " + std::to_string(kLongestPrint) + " bytes"};
    }
    ++at_;
    return Condition{.comparison = {.subject = "the program",
                                    .relation = Relation::kPrints,
                                    .word = std::string(text.substr(1, text.size() - 2))}};
  }

  Result<Condition> Between(Comparison low) {
    low.relation = Relation::kAtLeast;
    const auto least = TakeNumber();
    if (!least) return Expected("a number");
    if (!Takes("and")) return Expected("'and'");
    const auto most = TakeNumber();
    if (!most) return Expected("a number");
    if (*most < *least) return Error{"between: the second number is below the first"};
    low.number = *least;
    TakeUnit(&low);
    Comparison high = low;
    high.relation = Relation::kAtMost;
    high.number = *most;
    return Condition{.kind = Condition::Kind::kAll,
                     .parts = {{.comparison = std::move(low)}, {.comparison = std::move(high)}}};
  }

  Result<Condition> Is(Comparison comparison) {
    const bool negated = Takes("not");
    comparison.relation = Relation::kIs;
    if (at_ == words_.size()) return Expected("a number or a word");
    if (const auto number = TakeNumber()) {
      comparison.number = *number;
      if (Takes("+-")) {
        const auto tolerance = TakeNumber();
        if (!tolerance || *tolerance < 0) return Expected("a number that is not negative");
        comparison.relation = Relation::kNear;
        comparison.tolerance = *tolerance;
      }
      TakeUnit(&comparison);
    } else {
      if (!IsUnit(Now()) || Now() == "(" || IsOperator(Now().front())) {
        return Expected("a number or a word");
      }
      comparison.word = words_[at_++];
    }
    Condition is{.comparison = std::move(comparison)};
    return negated ? Not(std::move(is)) : std::move(is);
  }

  static Condition Not(Condition inner) {
    Condition negated{.kind = Condition::Kind::kNot};
    negated.parts.push_back(std::move(inner));
    return negated;
  }

  std::string_view Now() const { return words_[at_]; }

  bool Takes(std::string_view word) {
    if (at_ == words_.size() || Now() != word) return false;
    ++at_;
    return true;
  }

  std::optional<double> TakeNumber() {
    if (at_ == words_.size()) return std::nullopt;
    const auto number = NumberOf(Now());
    if (number) ++at_;
    return number;
  }

  void TakeUnit(Comparison* comparison) {
    if (at_ < words_.size() && IsUnit(Now())) comparison->unit = words_[at_++];
  }

  Error Expected(const std::string& what) const {
    const auto quoted = [](std::string_view word) {
      return "'" + std::string(word.substr(0, 40)) + "'";
    };
    std::string why = "expected " + what;
    if (at_ > 0) why += " after " + quoted(words_[at_ - 1]);
    return {why + ", got " + (at_ < words_.size() ? quoted(Now()) : "the end")};
  }

  std::vector<std::string_view> words_;
  std::size_t at_ = 0;
};

}  // namespace

Result<Condition> ReadCondition(std::string_view text) {
  if (text.size() > kLongest) {
    return Error{"a condition has at most " + std::to_string(kLongest) + " characters"};
  }
  return ConditionReader(text).Read();
}

std::string Text(const Comparison& comparison) {
  const std::string unit = comparison.unit.empty() ? "" : " " + comparison.unit;
  const auto number = [&](std::string_view relation) {
    return comparison.subject + " " + std::string(relation) + " " + NumberText(comparison.number);
  };
  switch (comparison.relation) {
    case Relation::kIs:
      if (!comparison.word.empty()) return comparison.subject + " is " + comparison.word;
      return number("is") + unit;
    case Relation::kNear:
      return number("is") + " +- " + NumberText(comparison.tolerance) + unit;
    case Relation::kHappens:
      return comparison.subject + " happens";
    case Relation::kArrives:
      return comparison.subject + " arrives";
    case Relation::kPrints:
      return comparison.subject + " prints \"" + comparison.word + "\"";
    case Relation::kBelow:
    case Relation::kAtMost:
    case Relation::kAbove:
    case Relation::kAtLeast:
      break;
  }
  return number(kNumeric[static_cast<std::size_t>(comparison.relation)].word) + unit;
}

// FNV-1a of 52 bits: from 2^53 on, where no number of an event's field is.
double WordNumber(std::string_view word) {
  std::uint64_t hash = 14695981039346656037U;
  for (const char c : word) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
  return 9007199254740992.0 + 2.0 * static_cast<double>(hash >> 12U);
}

}  // namespace understudy::judge
