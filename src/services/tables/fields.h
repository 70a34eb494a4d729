// Short functions to write the rows of the tables. Private to services/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "services/api_row.h"
#include "services/parameter.h"

namespace understudy::services::fields {

inline constexpr double kInf = std::numeric_limits<double>::infinity();

inline Field Bool(std::string_view key = "data") {
  return {.key = key, .type = &kBool, .required = true};
}
inline Field Flag(std::string_view key = "data") {
  return {.key = key, .type = &kFlag, .required = true};
}
inline Field Int(std::string_view key = "data", double low = -kInf, double high = kInf) {
  return {.key = key, .type = &schema::kWhole, .range = {low, high}, .required = true};
}
inline Field Number(std::string_view key = "data", double low = -kInf, double high = kInf) {
  return {.key = key, .range = {low, high}, .required = true};
}
inline Field Clamped(std::string_view key, double low, double high) {
  return {.key = key, .range = {low, high}, .required = true, .clamped = true};
}
inline Field Clamped(std::string_view key, double bound) { return Clamped(key, -bound, bound); }
inline Field Numbers(std::string_view key, std::size_t count) {
  return {.key = key, .type = &schema::kNumbers, .required = true, .count = count};
}
inline Field Text(std::string_view key) { return {.key = key, .type = &kString, .required = true}; }
inline Field Path(std::string_view key, std::size_t count) {
  return {.key = key, .type = &kPath, .required = true, .count = count};
}
inline Field Optional(Field field) {
  field.required = false;
  return field;
}

inline ApiRow Row(std::int64_t id, std::string_view name, std::vector<Field> fields, Effect effect,
                  std::string_view does, std::string_view source) {
  return {id, name, std::move(fields), std::move(effect), does, source};
}

// An api of the real robot that is not simulated.
inline ApiRow NotPlayed(std::int64_t id, std::string_view name, std::string_view source,
                        std::vector<Field> fields = {}) {
  return Row(id, name, std::move(fields), NoController{}, "not simulated", source);
}

}  // namespace understudy::services::fields
