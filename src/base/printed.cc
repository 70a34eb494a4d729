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

std::string Printable(std::string text) {
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' ' || c == 0x7F; }, '?');
  return text;
}

std::string Escaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '&') escaped += "&amp;";
    if (c == '<') escaped += "&lt;";
    if (c == '>') escaped += "&gt;";
    if (c == '"') escaped += "&quot;";
    const bool written = c == '&' || c == '<' || c == '>' || c == '"';
    const bool control = static_cast<unsigned char>(c) < ' ' && c != '\n' && c != '\t';
    if (!written) escaped += control ? '?' : c;
  }
  return escaped;
}

}  // namespace understudy
