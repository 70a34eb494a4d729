// Reads a request as it comes from the bus.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace understudy::services {

// A unitree_api Request_, without a copy of its parameter.
struct RequestView {
  std::int64_t id = 0;
  std::int64_t api_id = 0;
  std::int64_t lease_id = 0;
  std::int32_t priority = 0;
  bool noreply = false;
  std::string_view parameter{};  // up to its first zero byte; valid as long as the bytes
  std::size_t binary_bytes = 0;
};

// Decodes a serialized Request_ in this machine's byte order (bus::CdrSample::bytes); XCDR1 and
// XCDR2 have the same bytes. Returns nullopt if they end too soon. Takes as long for any request.
std::optional<RequestView> ReadRequest(std::span<const std::byte> bytes);

}  // namespace understudy::services
