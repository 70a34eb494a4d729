#include "server/http.h"

#include <algorithm>
#include <charconv>

#include <nlohmann/json.hpp>

namespace understudy::server {
namespace {

// A % that no two hexadecimal digits follow stands for itself, and + for a space.
std::string Unescaped(std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned char byte = 0;
    const char* const digits = text.data() + i + 1;
    if (text[i] == '%' && i + 2 < text.size() &&
        std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      plain += static_cast<char>(byte);
      i += 2;
    } else {
      plain += text[i] == '+' ? ' ' : text[i];
    }
  }
  return plain;
}

}  // namespace

std::string JsonText(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

HttpReply ErrorReply(unsigned status, std::string_view why) {
  return {.status = status, .body = JsonText({{"error", why}}) + "\n"};
}

std::string_view PathOf(const HttpRequest& request) {
  return request.target.substr(0, request.target.find('?'));
}

std::optional<std::string> QueryValue(const HttpRequest& request, std::string_view name) {
  const std::size_t mark = request.target.find('?');
  if (mark == std::string_view::npos) return std::nullopt;
  std::string_view query = request.target.substr(mark + 1);
  while (!query.empty()) {
    const std::string_view pair = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(query.size(), pair.size() + 1));
    const std::size_t equals = pair.find('=');
    if (pair.substr(0, equals) != name) continue;
    return equals == std::string_view::npos ? "" : Unescaped(pair.substr(equals + 1));
  }
  return std::nullopt;
}

}  // namespace understudy::server
