#pragma once

#include <span>
#include <string_view>

namespace understudy {

// The text of every file of idl/, in no particular order.
std::span<const std::string_view> IdlSources();

}  // namespace understudy
