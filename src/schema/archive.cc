#include "schema/archive.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "base/overloaded.h"

namespace understudy::schema {
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

std::string Quoted(std::string_view text) {
  if (IsPlain(text)) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

template <class List, class Write>
std::string ListText(const List& list, Write write) {
  std::string text;
  for (const auto& item : list) text += (text.empty() ? "" : ", ") + write(item);
  return "[" + text + "]";
}

const Type* TypeOf(const Slot& slot) {
  return std::visit(
      Overloaded{[](bool*) { return &kSwitch; }, [](int*) { return &kWhole; },
                 [](double*) { return &kNumber; }, [](std::optional<double>*) { return &kNumber; },
                 [](std::string*) { return &kText; }, [](std::span<double>) { return &kNumbers; },
                 [](std::vector<double>*) { return &kNumbers; },
                 [](std::vector<int>*) { return &kWholes; },
                 [](std::vector<std::string>*) { return &kTexts; }},
      slot);
}

}  // namespace

void Archive::VisitKey(std::string_view key, const About& about, const Slot& slot,
                       std::span<const std::string_view> words) {
  const auto* list = std::get_if<std::span<double>>(&slot);
  Visit({.key = key,
         .type = words.empty() ? TypeOf(slot) : &kWord,
         .unit = about.unit,
         .range = about.range,
         .does = about.does,
         .words = words,
         .nullable = std::holds_alternative<std::optional<double>*>(slot),
         .count = list == nullptr ? 0 : list->size()},
        slot);
}

void Archive::Word(Named<std::string> key, const About& about,
                   const std::vector<std::string>& words) {
  const std::vector<std::string_view> views(words.begin(), words.end());
  const auto found = std::ranges::find(words, *key.value);
  int index = found == words.end() ? -1 : static_cast<int>(found - words.begin());
  VisitKey(key.name, about, &index, views);
  if (index >= 0) *key.value = words[static_cast<std::size_t>(index)];
}

std::string ValueText(const Field& field, const Slot& slot) {
  const auto whole = [](int v) { return std::to_string(v); };
  return std::visit(
      Overloaded{
          [](const bool* v) { return std::string(*v ? "true" : "false"); },
          [&](const int* v) {
            if (field.words.empty()) return whole(*v);
            return Quoted(*v < 0 ? "" : field.words[static_cast<std::size_t>(*v)]);
          },
          [](const double* v) { return NumberText(*v); },
          [](const std::optional<double>* v) { return *v ? NumberText(**v) : "null"; },
          [](const std::string* v) { return Quoted(*v); },
          [](std::span<double> v) { return ListText(v, NumberText); },
          [](const std::vector<double>* v) { return ListText(*v, NumberText); },
          [&](const std::vector<int>* v) { return ListText(*v, whole); },
          [](const std::vector<std::string>* v) { return ListText(*v, Quoted); },
      },
      slot);
}

}  // namespace understudy::schema
