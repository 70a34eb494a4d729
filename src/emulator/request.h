// Requests: what people and scripts ask of a running robot. One table says which there are; JSON,
// YAML, command line, documents and recordings all read and write them by it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "base/result.h"

namespace understudy::emulator {

class Robot;
class World;
struct Request;

// What a request came to.
using Answer = Result<>;

enum class FieldKind : std::uint8_t {
  kNumber,
  kWhole,   // a number without a fraction
  kVector,  // three numbers
  kSwitch,  // true or false; on and off will do
  kSpeed,   // as time::IsSpeed has it; max is 0
  kWord,    // one of the field's words, kept as its index
  kKeys,    // of the remote controller, as in L2+B, kept as bits; "" where `low` is 0
  kBody,    // the name of a body of the model
  kName,    // the name of something else
  kJson,    // JSON, as text
};

// One value of a request.
struct Field {
  std::string_view key;
  FieldKind kind = FieldKind::kNumber;
  std::string_view unit{};
  double low = 0, high = 0;  // of each number, inclusive
  std::string_view does{};
  std::span<const std::string_view> words{};  // of kWord
  std::optional<double> otherwise{};          // of each number where it is not given
  bool required = false;
  bool bare = false;  // on the command line: a bare word, not --key
};

// Who may ask. A run that is paused plays no script.
enum class From : std::uint8_t { kBoth, kPeople, kScript };

struct RequestRow {
  std::string_view name;  // "crane.lower"
  std::string_view does;
  std::vector<Field> fields;
  // Does it at t [s, simulated], or says why not; what was left to the robot to choose (which body,
  // which pose) is then filled in. In the tick: allocates nothing unless it refuses.
  Answer (*carry_out)(World& world, Robot& robot, Request& request, double t);
  std::string_view example;  // of the command line
  bool noted = false;        // is no other event
  From from = From::kBoth;
  // "" where the fields that are given go together, else why not; null: they always do.
  std::string_view (*check)(const Request& request) = nullptr;
};

inline constexpr std::size_t kMostFields = 6;
inline constexpr std::size_t kLongestName = 63;   // bytes
inline constexpr std::size_t kLongestJson = 255;  // bytes; *assumed*

// One request with its values, by the fields of its row. A plain value: copying allocates nothing.
struct Request {
  const RequestRow* row = nullptr;
  std::array<std::array<double, 3>, kMostFields> numbers{};
  std::array<bool, kMostFields> given{};
  std::array<char, kLongestName + 1> text{};  // of the field that is a name, "" where none is given
  std::array<char, kLongestJson + 1> json_text{};  // likewise of the one that is JSON

  // By the key of a field, which the row must have; where it was not given, what it is then.
  bool has(std::string_view key) const { return given[Index(key)]; }
  double number(std::string_view key) const { return numbers[Index(key)][0]; }
  bool on(std::string_view key) const { return number(key) != 0; }
  Eigen::Vector3d vector(std::string_view key) const {
    return Eigen::Vector3d(numbers[Index(key)].data());
  }
  std::string_view name() const { return text.data(); }
  std::string_view json() const { return json_text.data(); }

  void SetNumber(std::string_view key, double value);
  void SetName(std::string_view key, std::string_view name);

 private:
  std::size_t Index(std::string_view key) const;
};

// A request that a script makes.
struct ScriptEvent {
  double at = 0;  // simulated s
  Request request{};
  std::string where{};  // "stand.yaml:3"
};

// All that there are, in the order of documents.
const std::vector<RequestRow>& RequestRows();

// The row of that name; an Error names the nearest.
Result<const RequestRow*> FindRequest(std::string_view name);

// Reads the values of a request: an object of them, or nothing where none is required, or the value
// of its first field alone where that is a bare one. An Error says which field, what was expected
// and what was found; of what was found only so much that a line can hold it. Never recurses.
Result<Request> ReadRequest(const RequestRow& row, const nlohmann::json& values);
Result<Request> ReadRequest(std::string_view name, const nlohmann::json& values = {});

// The values that were given, as ReadRequest takes them.
nlohmann::ordered_json ValuesOf(const Request& request);

// "push base_link 0 50 0 N for 0.1 s": the name, and what was given.
std::string Describe(const Request& request);

// What a field takes: "a number from -10 to 10 m".
std::string Expected(const Field& field);

// A value for a message: what is not UTF-8 is replaced, what is long is cut.
std::string Shown(const nlohmann::json& value);

// A number as short as it goes: "0.25", "1000000".
std::string NumberText(double number);

// A value of a command line or an unquoted one of YAML: a number, true, false, or text.
nlohmann::json ValueOf(const std::string& word);

}  // namespace understudy::emulator
