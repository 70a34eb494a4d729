// Decodes the parameter of a request against its row.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include <nlohmann/json.hpp>

#include "services/api_row.h"

namespace understudy::services {

// More is refused unread (the bound is assumed): reading a text of this size takes about 0.1 ms of
// the tick's thread. The longest parameter of the vendor's clients, 30 path points, has 6 kB.
inline constexpr std::size_t kMostParameterBytes = 16384;

// The object with the schema's keys alone, numbers clamped where their field says so; nullopt when
// `text` is no JSON, lacks a field, has one of another type or one out of range. Where no field is
// required, "" and "{}" are the same, and so is anything else where there is no field at all.
std::optional<nlohmann::json> DecodeParameter(std::string_view text, std::span<const Field> fields);

// The schema in one line, such as {"x": number -0.75..0.75 clamped}; "" without fields.
std::string DescribeFields(std::span<const Field> fields);

}  // namespace understudy::services
