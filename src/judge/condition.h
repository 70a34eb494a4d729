// The words of conditions, as scenarios have them: "base.height < 0.8", "lowcmd arrives".
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace understudy::judge {

enum class Relation : std::uint8_t {
  kBelow,    // <
  kAtMost,   // <=
  kAbove,    // >
  kAtLeast,  // >=
  kIs,       // is 3, is damping: exactly
  kNear,     // is 0.3 +- 0.02
  kHappens,  // an event
  kArrives,  // a message of a topic
  kPrints,   // a line of the program
};

struct Comparison {
  std::string subject{};  // a signal, an event or a topic
  Relation relation = Relation::kHappens;
  double number = 0;
  double tolerance = 0;  // of kNear
  std::string word{};    // of kIs, in place of a number; of kPrints what is printed
  std::string unit{};    // as written, "" for the signal's own

  bool operator==(const Comparison&) const = default;
};

struct Condition {
  enum class Kind : std::uint8_t { kComparison, kNot, kAll, kAny };

  Kind kind = Kind::kComparison;
  Comparison comparison{};         // of kComparison
  std::vector<Condition> parts{};  // one, or of kAll and kAny at least two
};

// Reads a condition:
//
//   condition   all {"or" all}
//   all         one {"and" one}
//   one         "not" one | "(" condition ")" | comparison
//   comparison  SUBJECT ("<" | "<=" | ">" | ">=") NUMBER [UNIT]
//             | SUBJECT "between" NUMBER "and" NUMBER [UNIT]
//             | SUBJECT "is" ["not"] (NUMBER ["+-" NUMBER] [UNIT] | WORD)
//             | SUBJECT ("happens" | "arrives")
//             | "the" "program" "prints" TEXT
//
// A TEXT stands between double quotes and has none inside.
//
// An Error says what was expected after what.
Result<Condition> ReadCondition(std::string_view text);

// Returns it as ReadCondition reads it.
std::string Text(const Comparison& comparison);

// Returns the number by which a word is compared, 2^53 or more. The same word has the same number
// in every process.
double WordNumber(std::string_view word);

}  // namespace understudy::judge
