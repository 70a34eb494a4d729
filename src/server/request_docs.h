// The table of requests as documents and clients have it.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "emulator/request.h"

namespace understudy::server {

// "BODY" of "body", as documents and the command line write a bare value.
std::string Capitals(std::string_view key);

// Where it is POSTed: "/crane/lower".
std::string RequestPath(const emulator::RequestRow& row);

// {"requests": [{"name": ..., "does": ..., "from": ..., "fields": [{"key": ..., ...}]}]}
nlohmann::ordered_json RequestsJson();

// docs/requests.md
std::string RequestsReference();

// The paths of requests, as they stand in docs/openapi.yaml.
std::string RequestsOpenApi();

}  // namespace understudy::server
