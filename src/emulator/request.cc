#include "emulator/request.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>

#include "base/nearest_word.h"
#include "base/printed.h"
#include "emulator/live_settings.h"
#include "robot/remote_keys.h"
#include "time/pace.h"

namespace understudy::emulator {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

Error Refused(const Field& field, const json& value) {
  return {std::string(field.key) + ": expected " + Expected(field) + ", got " + Shown(value)};
}

std::optional<double> Number(const Field& field, const json& value) {
  if (!value.is_number()) return std::nullopt;
  const double number = value.get<double>();
  if (!(number >= field.low && number <= field.high)) return std::nullopt;
  if (field.kind == FieldKind::kWhole && number != std::floor(number)) return std::nullopt;
  return number;
}

std::optional<double> Switch(const json& value) {
  if (value.is_boolean()) return value.get<bool>() ? 1 : 0;
  if (value == "on") return 1;
  if (value == "off") return 0;
  return std::nullopt;
}

std::optional<double> Speed(const json& value) {
  if (value == "max") return 0;
  if (!value.is_number() || !time::IsSpeed(value.get<double>())) return std::nullopt;
  return value.get<double>();
}

std::optional<double> Keys(const Field& field, const json& value) {
  if (!value.is_string()) return std::nullopt;
  const auto& chord = value.get_ref<const std::string&>();
  if (chord.empty() && field.low == 0) return 0;
  return robot::RemoteKeys(chord);
}

std::optional<double> Single(const Field& field, const json& value) {
  switch (field.kind) {
    case FieldKind::kNumber:
    case FieldKind::kWhole:
      return Number(field, value);
    case FieldKind::kSwitch:
      return Switch(value);
    case FieldKind::kSpeed:
      return Speed(value);
    case FieldKind::kKeys:
      return Keys(field, value);
    case FieldKind::kWord:
    case FieldKind::kVector:
    case FieldKind::kBody:
    case FieldKind::kName:
    case FieldKind::kJson:
    case FieldKind::kFile:
    case FieldKind::kSetting:
    case FieldKind::kValue:
      break;
  }
  return std::nullopt;
}

Result<> ReadField(const Field& field, const json& value, Request* request) {
  // Names, JSON and files.
  if (field.kind == FieldKind::kBody || field.kind == FieldKind::kName ||
      field.kind == FieldKind::kSetting) {
    const bool text = value.is_string() && !value.get_ref<const std::string&>().empty() &&
                      value.get_ref<const std::string&>().size() <= kLongestName;
    if (!text) return Refused(field, value);
    if (field.kind == FieldKind::kSetting) {
      if (auto known = FindSetting(value.get_ref<const std::string&>()); !known) {
        return Error{std::string(field.key) + ": " + known.why()};
      }
    }
    request->SetName(field.key, value.get_ref<const std::string&>());
    return {};
  }
  if (field.kind == FieldKind::kJson || field.kind == FieldKind::kFile) {
    const auto* text = value.get_ptr<const std::string*>();
    if (text == nullptr || text->size() > kLongestText) return Refused(field, value);
    const bool fits = field.kind == FieldKind::kJson
                          ? json::accept(*text)
                          : !text->empty() && text->find('\0') == std::string::npos;
    if (!fits) return Refused(field, value);
    std::ranges::copy(*text, request->long_text.begin());
    request->given[static_cast<std::size_t>(&field - request->row->fields.data())] = true;
    return {};
  }
  if (field.kind == FieldKind::kValue) {
    std::string text;
    if (value.is_boolean()) text = value.get<bool>() ? "true" : "false";
    if (value.is_string()) text = value.get<std::string>();
    const bool number = value.is_number() && std::isfinite(value.get<double>());
    if (!number && (text.empty() || text.size() > kLongestText)) return Refused(field, value);
    if (number) {
      request->SetNumber(field.key, value.get<double>());
    } else {
      std::ranges::copy(text, request->long_text.begin());
      request->given[static_cast<std::size_t>(&field - request->row->fields.data())] = true;
    }
    return {};
  }
  // Vectors and words.
  if (field.kind == FieldKind::kVector) {
    if (!value.is_array() || value.size() != 3) return Refused(field, value);
    const auto place = static_cast<std::size_t>(&field - request->row->fields.data());
    for (std::size_t i = 0; i < 3; ++i) {
      const auto number = Number(field, value[i]);
      if (!number) return Refused(field, value[i]);
      request->numbers[place][i] = *number;
    }
    request->given[place] = true;
    return {};
  }
  if (field.kind == FieldKind::kWord) {
    const auto word = value.is_string() ? std::ranges::find(field.words, value.get<std::string>())
                                        : field.words.end();
    if (word == field.words.end()) {
      const std::vector<std::string> words(field.words.begin(), field.words.end());
      Error error = Refused(field, value);
      if (value.is_string()) error.why += NearestHint(value.get<std::string>(), words);
      return error;
    }
    request->SetNumber(field.key, static_cast<double>(word - field.words.begin()));
    return {};
  }
  // All kinds of single numbers.
  const auto number = Single(field, value);
  if (!number) {
    Error error = Refused(field, value);
    if (field.kind == FieldKind::kSpeed && value == 0) error.why += "; to stand still use pause";
    return error;
  }
  request->SetNumber(field.key, *number);
  return {};
}

Result<> ReadFields(const json& values, Request* request, std::string* at) {
  const std::vector<Field>& fields = request->row->fields;
  for (const auto& item : values.items()) {
    *at = item.key();
    if (item.key() == kRobotField.key) {
      const auto number = Number(kRobotField, item.value());
      if (!number) return Refused(kRobotField, item.value());
      request->robot = static_cast<std::size_t>(*number);
      continue;
    }
    const auto field = std::ranges::find(fields, item.key(), &Field::key);
    if (field == fields.end()) {
      std::vector<std::string> keys;
      for (const Field& known : fields) keys.emplace_back(known.key);
      if (keys.empty()) return Error{"unknown key " + Shown(item.key()) + "; it takes none"};
      return Error{"unknown key " + Shown(item.key()) + DidYouMean(item.key(), keys)};
    }
    if (auto read = ReadField(*field, item.value(), request); !read) return read;
  }
  at->clear();
  return {};
}

}  // namespace

std::size_t Request::Index(std::string_view key) const {
  const auto field = std::ranges::find(row->fields, key, &Field::key);
  assert(field != row->fields.end());
  return static_cast<std::size_t>(field - row->fields.begin());
}

bool Request::waits() const {
  return (row->name == "step" && on("wait")) || row->name.starts_with("record.");
}

void Request::SetNumber(std::string_view key, double value) {
  numbers[Index(key)][0] = value;
  given[Index(key)] = true;
}

void Request::SetName(std::string_view key, std::string_view name) {
  *std::copy_n(name.begin(), std::min(name.size(), kLongestName), text.begin()) = '\0';
  given[Index(key)] = true;
}

Result<const RequestRow*> FindRequest(std::string_view name) {
  const auto row = std::ranges::find(RequestRows(), name, &RequestRow::name);
  if (row != RequestRows().end()) return &*row;
  std::vector<std::string> names;
  for (const RequestRow& known : RequestRows()) names.emplace_back(known.name);
  const std::string shown(name.substr(0, 64));
  return Error{"no request " + Shown(shown) + DidYouMean(shown, names)};
}

Result<Request> ReadRequest(const RequestRow& row, const json& values, std::string* at) {
  std::string unasked;
  if (at == nullptr) at = &unasked;
  at->clear();
  Request request{.row = &row};
  for (std::size_t i = 0; i < row.fields.size(); ++i) {
    request.numbers[i].fill(row.fields[i].otherwise.value_or(0));
  }
  if (values.is_object()) {
    if (auto read = ReadFields(values, &request, at); !read) return read.error();
  } else if (!values.is_null()) {
    if (row.fields.empty() || !row.fields.front().bare) {
      return Error{"expected an object of its values, got " + Shown(values)};
    }
    if (auto read = ReadField(row.fields.front(), values, &request); !read) return read.error();
  }
  for (const Field& field : row.fields) {
    if (field.required && !request.has(field.key)) {
      return Error{std::string(field.key) + ": missing; expected " + Expected(field)};
    }
  }
  if (row.check != nullptr) {
    if (const std::string_view why = row.check(request); !why.empty()) {
      return Error{std::string(why)};
    }
  }
  return request;
}

Result<Request> ReadRequest(std::string_view name, const json& values, std::string* at) {
  const auto row = FindRequest(name);
  return row ? ReadRequest(**row, values, at) : row.error();
}

ordered_json ValuesOf(const Request& request) {
  ordered_json values = ordered_json::object();
  if (request.robot != 0) values[std::string(kRobotField.key)] = request.robot;
  for (std::size_t i = 0; i < request.row->fields.size(); ++i) {
    if (!request.given[i]) continue;
    const Field& field = request.row->fields[i];
    const std::array<double, 3>& numbers = request.numbers[i];
    ordered_json& value = values[std::string(field.key)];
    switch (field.kind) {
      case FieldKind::kNumber:
        value = numbers[0];
        break;
      case FieldKind::kSpeed:
        value = numbers[0] == 0 ? ordered_json("max") : ordered_json(numbers[0]);
        break;
      case FieldKind::kWhole:
        value = static_cast<std::int64_t>(numbers[0]);
        break;
      case FieldKind::kVector:
        value = numbers;
        break;
      case FieldKind::kSwitch:
        value = numbers[0] != 0;
        break;
      case FieldKind::kWord:
        value = field.words[static_cast<std::size_t>(numbers[0])];
        break;
      case FieldKind::kKeys:
        value = robot::RemoteKeyNames(static_cast<std::uint16_t>(numbers[0]));
        break;
      case FieldKind::kBody:
      case FieldKind::kName:
      case FieldKind::kSetting:
        value = request.name();
        break;
      case FieldKind::kValue:
        value = request.setting().empty() ? ordered_json(numbers[0])
                                          : ordered_json(ValueOf(std::string(request.setting())));
        break;
      case FieldKind::kJson:
      case FieldKind::kFile:
        value = request.long_text.data();
        break;
    }
  }
  return values;
}

std::string Describe(const Request& request) {
  std::string text(request.row->name);
  const ordered_json values = ValuesOf(request);
  for (const Field& field : request.row->fields) {
    const auto value = values.find(std::string(field.key));
    if (value == values.end()) continue;
    if (!field.bare) text += " " + std::string(field.key);
    if (value->is_string()) text += " " + value->get<std::string>();
    if (value->is_boolean()) text += value->get<bool>() ? " on" : " off";
    if (value->is_number()) text += " " + NumberText(value->get<double>());
    if (value->is_array()) {
      for (const ordered_json& part : *value) text += " " + NumberText(part.get<double>());
    }
    if (!field.unit.empty() && !value->is_string()) text += " " + std::string(field.unit);
  }
  if (request.robot != 0) text += " robot " + std::to_string(request.robot);
  return text;
}

std::string Expected(const Field& field) {
  const std::string range = " from " + NumberText(field.low) + " to " + NumberText(field.high) +
                            (field.unit.empty() ? "" : " " + std::string(field.unit));
  switch (field.kind) {
    case FieldKind::kNumber:
      return "a number" + range;
    case FieldKind::kWhole:
      return "a whole number" + range;
    case FieldKind::kVector:
      return "three numbers" + range;
    case FieldKind::kSwitch:
      return "true or false";
    case FieldKind::kSpeed:
      return time::kSpeedRange;
    case FieldKind::kWord: {
      std::string words;
      for (const std::string_view word : field.words) {
        words += (words.empty() ? "" : ", ") + std::string(word);
      }
      return "one of " + words;
    }
    case FieldKind::kKeys:
      return "keys of the remote controller, as in L2+B";
    case FieldKind::kBody:
      return "the name of a body";
    case FieldKind::kName:
      return "a name";
    case FieldKind::kJson:
      return "JSON as text of at most " + std::to_string(kLongestText) + " bytes";
    case FieldKind::kSetting:
      return "a key that can change";
    case FieldKind::kValue:
      return "a value of that key";
    case FieldKind::kFile:
      return "a path of at most " + std::to_string(kLongestText) + " bytes";
  }
  return {};
}

// Shows only the kind of arrays and objects: dump() recurses as deep as a client has nested them.
std::string Shown(const json& value) {
  constexpr std::size_t kLongest = 40;
  if (value.is_structured()) return std::string{"an "} + value.type_name();
  if (value.is_number()) return NumberText(value.get<double>());
  const std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  return text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
}

std::string NumberText(double number) {
  const bool whole = number == std::floor(number) && std::abs(number) <= 1e6;
  return Printed(whole ? "%.0f" : "%.4g", number);
}

json ValueOf(const std::string& word) {
  if (word == "true") return true;
  if (word == "false") return false;
  double number = 0;
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, number);
  if (error == std::errc() && stop == end && std::isfinite(number)) return number;
  return word;
}

}  // namespace understudy::emulator
