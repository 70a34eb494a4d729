// A request and a reply as the routes see them: HTTP without its transport.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace understudy::server {

struct HttpRequest {
  std::string_view method;
  std::string_view target;  // path and perhaps a query
  std::string_view body{};
  // Header fields; "" where there is none.
  std::string_view host{};
  std::string_view origin{};
  std::string_view authorization{};
  std::string_view if_none_match{};
  bool upgrade = false;  // asks for a WebSocket
};

struct HttpReply {
  unsigned status = 200;
  std::string body{};
  std::string allow{};  // the method that the path does take; only beside status 405
  std::string type = "application/json";
  std::vector<std::pair<std::string, std::string>> fields{};  // further ones of the header
  // In place of `body`: what may be large and go to several clients at once.
  std::shared_ptr<const std::string> shared{};

  const std::string& content() const { return shared ? *shared : body; }
};

// On one line, whatever bytes its texts hold.
std::string JsonText(const nlohmann::ordered_json& json);

// {"error": why}, whatever bytes `why` holds.
HttpReply ErrorReply(unsigned status, std::string_view why);

std::string_view PathOf(const HttpRequest& request);
// The value of `name` in the query, %-sequences read; nullopt where it is not there.
std::optional<std::string> QueryValue(const HttpRequest& request, std::string_view name);

}  // namespace understudy::server
