// Text as std::printf writes it.
#pragma once

#include <string>

namespace understudy {

[[gnu::format(printf, 1, 2)]] std::string Printed(const char* format, ...);

}  // namespace understudy
