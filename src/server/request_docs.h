// The table of requests as documents and clients have it.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "emulator/request.h"

namespace understudy::server {

// Where it is POSTed: "/crane/lower".
std::string RequestPath(const emulator::RequestRow& row);

// {"requests": [{"name": ..., "does": ..., "from": ..., "fields": [{"key": ..., ...}]}]}
nlohmann::ordered_json RequestsJson();

// docs/requests.md
std::string RequestsReference();

// The paths of requests, as they stand in docs/openapi.yaml.
std::string RequestsOpenApi();

}  // namespace understudy::server
