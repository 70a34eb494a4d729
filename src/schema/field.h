// What a key takes: the one description by which its value is read, refused and documented, in
// YAML, JSON and on the command line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "schema/node.h"

namespace understudy::schema {

// The allowed values of a number, both ends included. Infinities and NaN are never allowed.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool above = false;  // the lower end is not allowed

  bool Holds(double number) const {
    return number <= max && (above ? number > min : number >= min);
  }
};

// At least zero.
inline constexpr Range kNotNegative{0, std::numeric_limits<double>::infinity()};

struct Field;

// A value that a field takes: a number, 1 or 0 of a switch, the index of a word; or text, which
// lives as long as the node or the field.
struct Taken {
  double number = 0;
  std::string_view text{};
};

enum class Form : std::uint8_t { kNumber, kText, kOther };

// A type of values. Rooms add types of their own, such as keys of the remote controller.
struct Type {
  std::string_view name;      // in JSON documents: "number"
  std::string_view expected;  // in errors, before range or words: "a number"
  std::string_view allowed;   // in tables, before those: "whole, "
  Form form;  // kNumber has a range; a word of a command line for kText is text, even if it is 12
  // Returns the value if the field takes it; null for a list, whose items `item` takes.
  std::optional<Taken> (*take)(const Field& field, const Node& node) = nullptr;
  // Returns a taken value as JSON; null: its text for kText, else its number.
  nlohmann::json (*json)(const Field& field, const Taken& taken) = nullptr;
  const Type* item = nullptr;

  bool has_range() const { return form == Form::kNumber; }
  bool is_text() const { return form == Form::kText; }
};

extern const Type kNumber;
extern const Type kWhole;    // a number without a fraction, within ±2^53: 3 or 3.0
extern const Type kSwitch;   // true or false; also on and off
extern const Type kWord;     // one of the field's words
extern const Type kText;     // one line; of YAML any scalar
extern const Type kNumbers;  // a list of `count` numbers, of any length where that is 0
extern const Type kWholes;
extern const Type kTexts;
extern const Type kVector;  // three numbers
extern const Type kTree;    // a value that other code reads; `takes` says what it is

struct Field {
  std::string_view key;
  const Type* type = &kNumber;
  std::string_view unit{};  // "" if there is none
  Range range{};            // of a number, or of each number of a list
  std::string_view does{};
  std::string_view takes{};                   // in place of what its type expects
  std::span<const std::string_view> words{};  // of kWord
  std::optional<double> otherwise{};          // default of each number
  bool required = false;
  bool bare = false;        // on the command line a positional word, not --key
  bool clamped = false;     // a number out of range is moved to its nearest end
  bool nullable = false;    // null is "no value"
  std::size_t count = 0;    // elements of a list; 0 = any
  std::string_view also{};  // a second key that some clients use for it

  bool is_list() const { return type->item != nullptr; }
};

// Returns the field of each element of a list.
Field ItemOf(const Field& field);

// Returns the value if the field, which is no list, takes it.
inline std::optional<Taken> Take(const Field& field, const Node& node) {
  return field.type->take(field, node);
}

// Returns a taken value in the form in which JSON has it.
nlohmann::json JsonOf(const Field& field, const Taken& taken);

// Returns "expected a number from 0 to 10 s, got 'fast'", with the nearest word where there is one.
std::string Refusal(const Field& field, const Node& node);

// Returns what a value must be, for errors: "a number from 0 to 10 s", "one of strict, lenient".
std::string Expected(const Field& field);

// Returns what a value may be, for tables: "0 to 10", "strict, lenient", "text".
std::string Allowed(const Field& field);

// Returns a short text that reads back as the same number: "0.0001", "1000000", "1e+08".
std::string NumberText(double value);

}  // namespace understudy::schema
