#include "base/printed.h"

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>

namespace understudy {

std::string Printed(const char* format, ...) {
  std::array<char, 256> few{};
  std::va_list values, again;
  va_start(values, format);
  va_copy(again, values);
  const auto size =
      static_cast<std::size_t>(std::vsnprintf(few.data(), few.size(), format, values));
  std::string text(few.data(), std::min(size, few.size() - 1));
  if (size > text.size()) {
    text.resize(size);
    std::vsnprintf(text.data(), size + 1, format, again);
  }
  va_end(again);
  va_end(values);
  return text;
}

}  // namespace understudy
