// Requests to a running robot, from people and scripts. One table defines them for JSON, YAML, the
// command line, the documentation and recordings.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "base/result.h"
#include "schema/field.h"

namespace understudy::emulator {

class Robot;
class World;
struct Request;

// The result of a request.
using Answer = Result<>;

using schema::Field;

// The types of values that only requests have.
namespace types {
extern const schema::Type kSpeed;      // as time::IsSpeed has it, or max, which is 0
extern const schema::Type kKeys;       // of the remote controller, as in L2+B, stored as bits
extern const schema::Type kMaybeKeys;  // the same, or "" for none
extern const schema::Type kBody;       // the name of a body of the model
extern const schema::Type kName;       // another name
extern const schema::Type kJson;       // JSON, as text
extern const schema::Type kFile;       // a path on the robot's machine
extern const schema::Type kSetting;    // a key of LiveSettings
extern const schema::Type kValue;      // of a setting: a number, true, false or a word
}  // namespace types

// Who may make the request. Scripts do not run while paused, so they cannot resume or step.
enum class From : std::uint8_t { kBoth, kPeople, kScript };

struct RequestRow {
  std::string_view name;  // "crane.lower"
  std::string_view does;
  std::vector<Field> fields;
  // Carries out the request at simulated time t [s], or returns the reason why not. Fills in values
  // that the robot chooses (a default body or pose). Runs in the tick: allocates only if it
  // refuses.
  Answer (*carry_out)(World& world, Robot& robot, Request& request, double t);
  std::string_view example;  // on the command line
  bool noted = false;        // recorded as an event kRequest
  From from = From::kBoth;
  // Checks the combination of given fields: returns "" or the reason why it is invalid; null: all
  // are valid.
  std::string_view (*check)(const Request& request) = nullptr;
  // What GET lists in place of it where no values are given, for the command line; "" for nothing.
  std::string_view list{};
};

inline constexpr std::size_t kMostFields = 7;
inline constexpr std::size_t kLongestName = 63;   // bytes
inline constexpr std::size_t kLongestText = 255;  // bytes, of JSON or a path; *assumed*

// One request with the values of its row's fields. Copying it does not allocate.
struct Request {
  const RequestRow* row = nullptr;
  std::size_t robot = 0;  // its number in the world
  std::array<std::array<double, 3>, kMostFields> numbers{};
  std::array<bool, kMostFields> given{};
  std::array<char, kLongestName + 1> text{};       // of the name field, "" if not given
  std::array<char, kLongestText + 1> long_text{};  // of the JSON, file or value field, or ""

  // Look up a field by its key, which the row must have. The value is the default if it was not
  // given.
  bool has(std::string_view key) const { return given[Index(key)]; }
  double number(std::string_view key) const { return numbers[Index(key)][0]; }
  bool on(std::string_view key) const { return number(key) != 0; }
  Eigen::Vector3d vector(std::string_view key) const {
    return Eigen::Vector3d(numbers[Index(key)].data());
  }
  std::string_view name() const { return text.data(); }
  std::string_view json() const { return long_text.data(); }
  std::string_view file() const { return long_text.data(); }
  // The word of a value, also true and false; "" for a number.
  std::string_view setting() const { return long_text.data(); }

  // Whether it is answered only when it is done: its steps are made, its recording is on or over.
  bool waits() const;

  void SetNumber(std::string_view key, double value);
  void SetName(std::string_view key, std::string_view name);

 private:
  std::size_t Index(std::string_view key) const;
};

// The field that every request has besides those of its row.
inline constexpr Field kRobotField{.key = "robot",
                                   .type = &schema::kWhole,
                                   .range = {0, 255},
                                   .does = "Number in the world",
                                   .otherwise = 0};

// Returns all requests, in the order of the documentation.
const std::vector<RequestRow>& RequestRows();

// Returns the row of that name, or an Error with the nearest name.
Result<const RequestRow*> FindRequest(std::string_view name);

// Reads the values of a request: an object; null if no field is required; or only the value of the
// first field if that is positional. An Error has the field, what was expected and what was found,
// shortened to a line; `at`, if not null, then gets the key of the wrong value, "" if it is none of
// `values`. Never recurses.
Result<Request> ReadRequest(const RequestRow& row, const nlohmann::json& values,
                            std::string* at = nullptr);
Result<Request> ReadRequest(std::string_view name, const nlohmann::json& values = {},
                            std::string* at = nullptr);

// Returns the given values in the form that ReadRequest takes.
nlohmann::ordered_json ValuesOf(const Request& request);

// Returns name and given values, as in "push base_link 0 50 0 N for 0.1 s".
std::string Describe(const Request& request);

// Formats a number as short as possible: "0.25", "1000000".
std::string NumberText(double number);

}  // namespace understudy::emulator
