// Decodes and checks the parameter of a request.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include <nlohmann/json.hpp>

#include "services/api_row.h"

namespace understudy::services {

// The types of values that only parameters have.
extern const schema::Type kBool;    // true or false
extern const schema::Type kFlag;    // true, false, 0 or 1: the vendor's clients disagree
extern const schema::Type kString;  // any text
// A list of objects of numbers, each with at least t_from_start, x, y and yaw.
extern const schema::Type kPath;

// Longer parameters are refused unread, and those of more values, of one of which begins or another
// follows at each [, { and comma outside of texts. Assumed: the vendor's longest parameter, 30 path
// points, has 6 kB and 300 values.
inline constexpr std::size_t kMostParameterBytes = 16384;
inline constexpr std::size_t kMostParameterValues = 512;

// Returns an object with only the keys of `fields`, numbers clamped if the field says so. Returns
// nullopt if `text` is not JSON or too much of it, or a field is missing, of the wrong type or out
// of range. If no field is required, "" means "{}"; if there are no fields, any text does.
std::optional<nlohmann::json> DecodeParameter(std::string_view text, std::span<const Field> fields);

// Describes the fields in one line: "x: a number from -0.75 to 0.75, clamped"; "" without fields.
std::string DescribeFields(std::span<const Field> fields);

}  // namespace understudy::services
