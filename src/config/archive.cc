#include "config/archive.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

#include "base/overloaded.h"

namespace understudy::config {
namespace {

// Text that a YAML reader takes as just that text, also inside [] and {}.
bool IsPlain(std::string_view text) {
  constexpr std::array<std::string_view, 6> kOther{"true", "false", "null", "Null", "NULL", "<<"};
  if (text.empty() || std::find(kOther.begin(), kOther.end(), text) != kOther.end()) return false;
  const auto letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  const auto inside = [&letter](char c) {
    return letter(c) || std::string_view("0123456789_-./").find(c) != std::string_view::npos;
  };
  return (letter(text[0]) || text[0] == '_' || text[0] == '/') &&
         std::all_of(text.begin(), text.end(), inside);
}

std::string TextText(const std::string& text) {
  if (IsPlain(text)) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

std::string Joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : ", ") + (word.empty() ? std::string("\"\"") : word);
  }
  return text;
}

std::string RangeText(const Range& range) {
  const bool low = std::isfinite(range.min);
  const bool high = std::isfinite(range.max);
  if (low && high) return NumberText(range.min) + " to " + NumberText(range.max);
  if (low) return "at least " + NumberText(range.min);
  if (high) return "at most " + NumberText(range.max);
  return "any";
}

// " from 0 to 10 s", "" for a number without bounds or unit.
std::string RangeClause(const Row& row) {
  std::string text;
  if (std::isfinite(row.range.min) && std::isfinite(row.range.max)) {
    text = " from " + RangeText(row.range);
  } else if (RangeText(row.range) != "any") {
    text = " of " + RangeText(row.range);
  } else if (!row.unit.empty()) {
    text = " in";
  }
  return row.unit.empty() ? text : text + " " + std::string(row.unit);
}

template <class Numbers>
std::string ListText(const Numbers& numbers) {
  std::vector<std::string> texts;
  for (const auto number : numbers) texts.push_back(NumberText(number));
  return "[" + Joined(texts) + "]";
}

}  // namespace

void Archive::Word(Named<std::string> key, const About& about,
                   const std::vector<std::string>& words) {
  const auto found = std::find(words.begin(), words.end(), *key.value);
  int index = found == words.end() ? -1 : static_cast<int>(found - words.begin());
  Visit(Row(key.name, about), WordSlot{words, &index});
  if (index >= 0) *key.value = words[static_cast<std::size_t>(index)];
}

std::string NumberText(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string ValueText(const Slot& slot) {
  return std::visit(Overloaded{
                        [](const bool* v) { return std::string(*v ? "true" : "false"); },
                        [](const int* v) { return std::to_string(*v); },
                        [](const double* v) { return NumberText(*v); },
                        [](const std::optional<double>* v) {
                          return v->has_value() ? NumberText(**v) : std::string("null");
                        },
                        [](const std::string* v) { return TextText(*v); },
                        [](const WordSlot& v) {
                          return *v.index < 0
                                     ? TextText("")
                                     : TextText(v.words[static_cast<std::size_t>(*v.index)]);
                        },
                        [](std::span<double> v) { return ListText(v); },
                        [](const std::vector<double>* v) { return ListText(*v); },
                        [](const std::vector<int>* v) { return ListText(*v); },
                        [](const std::vector<std::string>* v) {
                          std::vector<std::string> texts;
                          for (const std::string& text : *v) texts.push_back(TextText(text));
                          return "[" + Joined(texts) + "]";
                        },
                    },
                    slot);
}

std::string Expected(const Row& row, const Slot& slot) {
  return std::visit(
      Overloaded{
          [](const bool*) { return std::string("true or false"); },
          [&row](const int*) { return "a whole number" + RangeClause(row); },
          [&row](const double*) { return "a number" + RangeClause(row); },
          [&row](const std::optional<double>*) { return "a number" + RangeClause(row); },
          [](const std::string*) { return std::string("one line of text"); },
          [](const WordSlot& v) { return "one of " + Joined(v.words); },
          [&row](std::span<double> v) {
            return "a list of " + std::to_string(v.size()) + " numbers" + RangeClause(row);
          },
          [&row](const std::vector<double>*) { return "a list of numbers" + RangeClause(row); },
          [&row](const std::vector<int>*) { return "a list of whole numbers" + RangeClause(row); },
          [](const std::vector<std::string>*) { return std::string("a list of words"); },
      },
      slot);
}

std::string Allowed(const Row& row, const Slot& slot) {
  return std::visit(
      Overloaded{
          [](const bool*) { return std::string("true, false"); },
          [&row](const int*) { return "whole, " + RangeText(row.range); },
          [&row](const double*) { return RangeText(row.range); },
          [&row](const std::optional<double>*) { return RangeText(row.range) + ", null"; },
          [](const std::string*) { return std::string("text"); },
          [](const WordSlot& v) { return Joined(v.words); },
          [&row](std::span<double> v) {
            return std::to_string(v.size()) + " numbers, " + RangeText(row.range);
          },
          [&row](const std::vector<double>*) { return "numbers, " + RangeText(row.range); },
          [&row](const std::vector<int>*) { return "whole numbers, " + RangeText(row.range); },
          [](const std::vector<std::string>*) { return std::string("words"); },
      },
      slot);
}

}  // namespace understudy::config
