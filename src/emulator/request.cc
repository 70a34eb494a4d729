#include "emulator/request.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "base/nearest_word.h"
#include "base/printed.h"
#include "emulator/live_settings.h"
#include "robot/remote_keys.h"
#include "time/pace.h"

namespace understudy::emulator {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

using schema::Node;
using schema::Taken;
using schema::Type;

std::optional<Taken> TakeSpeed(const Field&, const Node& node) {
  if (node.text == "max") return Taken{0};
  const auto number = node.number;
  return number && time::IsSpeed(*number) ? std::optional(Taken{*number}) : std::nullopt;
}

std::optional<Taken> TakeKeys(const Field&, const Node& node) {
  const auto chord = node.text;
  const auto keys = chord ? robot::RemoteKeys(*chord) : std::nullopt;
  return keys ? std::optional(Taken{static_cast<double>(*keys)}) : std::nullopt;
}

std::optional<Taken> TakeMaybeKeys(const Field& field, const Node& node) {
  return node.text == "" ? Taken{0} : TakeKeys(field, node);
}

std::optional<Taken> TakeShort(std::optional<std::string_view> text, std::size_t most) {
  if (!text || text->empty() || text->size() > most) return std::nullopt;
  return Taken{0, *text};
}

std::optional<Taken> TakeName(const Field&, const Node& node) {
  return TakeShort(node.text, kLongestName);
}

std::optional<Taken> TakeJson(const Field&, const Node& node) {
  const auto taken = TakeShort(node.text, kLongestText);
  return taken && json::accept(taken->text) ? taken : std::nullopt;
}

std::optional<Taken> TakeFile(const Field&, const Node& node) {
  const auto taken = TakeShort(node.text, kLongestText);
  return taken && taken->text.find('\0') == std::string::npos ? taken : std::nullopt;
}

std::optional<Taken> TakeValue(const Field&, const Node& node) {
  if (const auto flag = node.flag) return Taken{0, *flag ? "true" : "false"};
  if (const auto number = node.number) return Taken{*number};
  return TakeShort(node.text, kLongestText);
}

json SpeedJson(const Field&, const Taken& taken) {
  return taken.number == 0 ? json("max") : json(taken.number);
}

json KeysJson(const Field&, const Taken& taken) {
  return robot::RemoteKeyNames(static_cast<std::uint16_t>(taken.number));
}

json ValueJson(const Field&, const Taken& taken) {
  return taken.text.empty() ? json(taken.number) : schema::JsonOfWord(std::string(taken.text));
}

Error Refused(const Field& field, const Node& value) {
  return {std::string(field.key) + ": " + schema::Refusal(field, value)};
}

bool IsName(const Field& field) {
  return field.type == &types::kBody || field.type == &types::kName ||
         field.type == &types::kSetting;
}

bool IsLongText(const Field& field) {
  return field.type == &types::kJson || field.type == &types::kFile || field.type == &types::kValue;
}

Result<> ReadField(const Field& field, const Node& value, Request* request) {
  const auto place = static_cast<std::size_t>(&field - request->row->fields.data());
  std::array<double, 3>& numbers = request->numbers[place];
  request->given[place] = true;
  if (field.type == &schema::kVector) {
    if (!value.json->is_array() || value.json->size() != numbers.size())
      return Refused(field, value);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const Node item = (*value.json)[i];
      const auto taken = Take(schema::ItemOf(field), item);
      if (!taken) return Refused(field, item);
      numbers[i] = taken->number;
    }
    return {};
  }
  const auto taken = Take(field, value);
  if (!taken) {
    Error error = Refused(field, value);
    if (field.type == &types::kSpeed && value.number == 0)
      error.why += "; to stand still use pause";
    return error;
  }
  if (field.type == &types::kSetting) {
    if (auto known = FindSetting(taken->text); !known) {
      return Error{std::string(field.key) + ": " + known.why()};
    }
  }
  numbers[0] = taken->number;
  if (IsName(field)) request->SetName(field.key, taken->text);
  if (IsLongText(field)) std::ranges::copy(taken->text, request->long_text.begin());
  return {};
}

Result<> ReadFields(const json& values, Request* request, std::string* at) {
  const std::vector<Field>& fields = request->row->fields;
  for (const auto& item : values.items()) {
    *at = item.key();
    if (item.key() == kRobotField.key) {
      const auto number = Take(kRobotField, item.value());
      if (!number) return Refused(kRobotField, item.value());
      request->robot = static_cast<std::size_t>(number->number);
      continue;
    }
    const auto field = std::ranges::find(fields, item.key(), &Field::key);
    if (field == fields.end()) {
      std::vector<std::string> keys;
      for (const Field& known : fields) keys.emplace_back(known.key);
      return Error{"unknown key " + Node(json(item.key())).shown() +
                   (keys.empty() ? "; it takes none" : DidYouMean(item.key(), keys))};
    }
    if (auto read = ReadField(*field, item.value(), request); !read) return read;
  }
  at->clear();
  return {};
}

}  // namespace

namespace types {

constexpr std::string_view kKeysExpected = "keys of the remote controller, as in L2+B";
const Type kSpeed{"speed", time::kSpeedRange, "", schema::Form::kOther, TakeSpeed, SpeedJson};
const Type kKeys{"keys", kKeysExpected, "", schema::Form::kText, TakeKeys, KeysJson};
const Type kMaybeKeys{"keys", kKeysExpected, "", schema::Form::kText, TakeMaybeKeys, KeysJson};
const Type kBody{"body", "the name of a body", "", schema::Form::kText, TakeName};
const Type kName{"name", "a name", "", schema::Form::kText, TakeName};
const Type kJson{"json", "JSON as text of at most 255 bytes", "", schema::Form::kText, TakeJson};
const Type kFile{"file", "a path of at most 255 bytes", "", schema::Form::kText, TakeFile};
const Type kSetting{"setting", "a key that can change", "", schema::Form::kText, TakeName};
const Type kValue{"value", "a value of that key", "", schema::Form::kOther, TakeValue, ValueJson};

}  // namespace types
static_assert(kLongestText == 255);  // as the texts above say

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
  return Error{"no request " + Node(json(shown)).shown() + DidYouMean(shown, names)};
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
      return Error{"expected an object of its values, got " + Node(values).shown()};
    }
    if (auto read = ReadField(row.fields.front(), values, &request); !read) return read.error();
  }
  for (const Field& field : row.fields) {
    if (field.required && !request.has(field.key)) {
      return Error{std::string(field.key) + ": missing; expected " + schema::Expected(field)};
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
    const std::string_view text = IsName(field)       ? request.name()
                                  : IsLongText(field) ? request.json()
                                                      : std::string_view();
    ordered_json& value = values[std::string(field.key)];
    if (field.type == &schema::kVector) {
      value = request.numbers[i];
    } else {
      value = schema::JsonOf(field, {request.numbers[i][0], text});
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

std::string NumberText(double number) {
  const bool whole = number == std::floor(number) && std::abs(number) <= 1e6;
  return Printed(whole ? "%.0f" : "%.4g", number);
}

}  // namespace understudy::emulator
