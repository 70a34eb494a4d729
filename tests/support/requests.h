// Requests for tests.
#pragma once

#include <stdexcept>
#include <string_view>

#include "emulator/request.h"

namespace understudy::test {

// One of the table with its values, which must be sound.
inline emulator::Request RequestOf(std::string_view name, const nlohmann::json& values = {}) {
  const auto request = emulator::ReadRequest(name, values);
  if (!request) throw std::logic_error(request.why());
  return *request;
}

}  // namespace understudy::test
