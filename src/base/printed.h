// Text for output.
#pragma once

#include <string>
#include <string_view>

namespace understudy {

// Returns what std::printf would print.
[[gnu::format(printf, 1, 2)]] std::string Printed(const char* format, ...);

// Returns a text without control characters: each becomes '?'. For names that strangers choose.
std::string Printable(std::string text);

// Returns a text for XML and HTML: with entities, without what XML cannot have.
std::string Escaped(std::string_view text);

}  // namespace understudy
