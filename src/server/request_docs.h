// Documents the table of requests for people and clients.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "emulator/request.h"

namespace understudy::server {

// Returns "BODY" for "body", the notation of positional values.
std::string Capitals(std::string_view key);

// Returns the path of the request's POST: "/crane/lower".
std::string RequestPath(const emulator::RequestRow& row);

// {"requests": [{"name": ..., "does": ..., "from": ..., "fields": [{"key": ..., ...}]}]}
nlohmann::ordered_json RequestsJson();

// Returns docs/reference/requests.md.
std::string RequestsReference();

// Returns the paths of requests, as openapi.yaml has them at its end.
std::string RequestsOpenApi();

}  // namespace understudy::server
