#include "schema/field.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/nearest_word.h"

namespace understudy::schema {
namespace {

std::optional<Taken> InRange(const Field& field, std::optional<double> number) {
  if (!number) return std::nullopt;
  if (field.clamped) return Taken{std::clamp(*number, field.range.min, field.range.max)};
  return field.range.Holds(*number) ? std::optional(Taken{*number}) : std::nullopt;
}

std::optional<Taken> TakeNumber(const Field& field, const Node& node) {
  return InRange(field, node.number);
}

std::optional<Taken> TakeWhole(const Field& field, const Node& node) {
  return InRange(field, node.whole);
}

std::optional<Taken> TakeSwitch(const Field&, const Node& node) {
  if (const auto flag = node.flag) return Taken{*flag ? 1.0 : 0.0};
  const auto text = node.text;
  if (text == "on") return Taken{1};
  if (text == "off") return Taken{0};
  return std::nullopt;
}

std::optional<Taken> TakeWord(const Field& field, const Node& node) {
  const auto text = node.text;
  const auto word = text ? std::ranges::find(field.words, *text) : field.words.end();
  if (word == field.words.end()) return std::nullopt;
  return Taken{static_cast<double>(word - field.words.begin()), *word};
}

std::optional<Taken> TakeText(const Field&, const Node& node) {
  const auto control = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; };
  const auto text = node.text;
  if (!text || std::ranges::any_of(*text, control)) return std::nullopt;
  return Taken{0, *text};
}

nlohmann::json WholeJson(const Field&, const Taken& taken) {
  return static_cast<std::int64_t>(taken.number);
}

nlohmann::json SwitchJson(const Field&, const Taken& taken) { return taken.number != 0; }

nlohmann::json WordJson(const Field& field, const Taken& taken) {
  return field.words[static_cast<std::size_t>(taken.number)];
}

// `none` stands for the empty word; "" leaves it out.
std::string Joined(std::span<const std::string_view> words, std::string_view none) {
  std::string text;
  for (std::string_view word : words) {
    if (word.empty()) word = none;
    if (!word.empty()) text += (text.empty() ? "" : ", ") + std::string(word);
  }
  return text;
}

std::string RangeText(const Range& range) {
  const bool low = std::isfinite(range.min);
  const bool high = std::isfinite(range.max);
  if (range.above) return "above " + NumberText(range.min) + ", up to " + NumberText(range.max);
  if (low && high) return NumberText(range.min) + " to " + NumberText(range.max);
  if (low) return "at least " + NumberText(range.min);
  if (high) return "at most " + NumberText(range.max);
  return "any";
}

// " from 0 to 10 s", "" for a number without bounds or unit.
std::string RangeClause(const Field& field) {
  const bool low = std::isfinite(field.range.min);
  const bool high = std::isfinite(field.range.max);
  std::string text;
  if (low || high) {
    const bool both = low && high && !field.range.above;
    text = (both ? " from " : field.range.above ? " " : " of ") + RangeText(field.range);
  } else if (!field.unit.empty()) {
    text = " in";
  }
  return field.unit.empty() ? text : text + " " + std::string(field.unit);
}

}  // namespace

const Type kNumber{"number", "a number", "", Form::kNumber, TakeNumber};
const Type kWhole{"whole", "a whole number", "whole, ", Form::kNumber, TakeWhole, WholeJson};
const Type kSwitch{"switch", "true or false", "true, false", Form::kOther, TakeSwitch, SwitchJson};
const Type kWord{"word", "one of ", "", Form::kText, TakeWord, WordJson};
const Type kText{"text", "one line of text", "text", Form::kText, TakeText};
const Type kNumbers{"numbers", "a list of numbers", "numbers, ", Form::kNumber, nullptr, nullptr,
                    &kNumber};
const Type kWholes{
    "wholes", "a list of whole numbers", "whole numbers, ", Form::kNumber, nullptr, nullptr,
    &kWhole};
const Type kTexts{"texts", "a list of words", "words", Form::kOther, nullptr, nullptr, &kText};
const Type kVector{"vector", "three numbers", "three numbers, ", Form::kNumber,
                   nullptr,  nullptr,         &kNumber};
const Type kTree{"tree", "", "", Form::kOther};

Field ItemOf(const Field& field) {
  return {.key = field.key,
          .type = field.type->item,
          .unit = field.unit,
          .range = field.range,
          .clamped = field.clamped};
}

nlohmann::json JsonOf(const Field& field, const Taken& taken) {
  if (field.type->json != nullptr) return field.type->json(field, taken);
  return field.type->is_text() ? nlohmann::json(taken.text) : nlohmann::json(taken.number);
}

std::string Refusal(const Field& field, const Node& node) {
  const auto text = field.words.empty() ? std::nullopt : node.text;
  return "expected " + Expected(field) + ", got " + node.shown() +
         (text ? NearestHint(*text, {field.words.begin(), field.words.end()}) : "");
}

std::string Expected(const Field& field) {
  if (!field.takes.empty()) return std::string(field.takes);
  constexpr std::string_view kListOf = "a list of ";
  std::string text(field.type->expected);
  if (field.count > 0) text.insert(kListOf.size(), std::to_string(field.count) + " ");
  return text + (field.type->has_range() ? RangeClause(field) : Joined(field.words, ""));
}

std::string Allowed(const Field& field) {
  const std::string count = field.count > 0 ? std::to_string(field.count) + " " : "";
  return count + std::string(field.type->allowed) +
         (field.type->has_range() ? RangeText(field.range) : Joined(field.words, "\"\"")) +
         (field.nullable ? ", null" : "");
}

std::string NumberText(double value) {
  std::array<char, 32> text{};
  const double size = std::abs(value);
  const bool plain = size >= 1e-4 && size <= 1e6;
  char* const end = text.data() + text.size();
  const auto written = plain ? std::to_chars(text.data(), end, value, std::chars_format::fixed)
                             : std::to_chars(text.data(), end, value);
  return {text.data(), written.ptr};
}

}  // namespace understudy::schema
