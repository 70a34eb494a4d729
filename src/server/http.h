// HTTP requests and replies, without the transport.
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
  std::string_view target;  // path and optional query
  std::string_view body{};
  // Header fields; "" if missing.
  std::string_view host{};
  std::string_view origin{};
  std::string_view authorization{};
  std::string_view if_none_match{};
  bool upgrade = false;  // requests a WebSocket
};

struct HttpReply {
  unsigned status = 200;
  std::string body{};
  std::string allow{};  // the valid method, with status 405
  std::string type = "application/json";
  std::vector<std::pair<std::string, std::string>> fields{};  // further header fields
  // Used in place of `body` for large bodies, which several clients can share.
  std::shared_ptr<const std::string> shared{};

  const std::string& content() const { return shared ? *shared : body; }
};

// Returns one line of JSON, with invalid UTF-8 replaced.
std::string JsonText(const nlohmann::ordered_json& json);

// Returns {"error": why}, with invalid UTF-8 replaced.
HttpReply ErrorReply(unsigned status, std::string_view why);

std::string_view PathOf(const HttpRequest& request);
// Returns the value of `name` in the query with %-sequences decoded; nullopt if it is missing.
std::optional<std::string> QueryValue(const HttpRequest& request, std::string_view name);

}  // namespace understudy::server
