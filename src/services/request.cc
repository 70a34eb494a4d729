#include "services/request.h"

#include <cstring>
#include <type_traits>

#include "services/parameter.h"

namespace understudy::services {
namespace {

// The places in the message, after the four bytes that name its encoding.
constexpr std::size_t kEncoding = 4;
constexpr std::size_t kId = 0, kApi = 8, kLease = 16, kPriority = 24, kNoreply = 28;
constexpr std::size_t kParameter = 32;  // its length with the zero byte, then its text
constexpr std::size_t kWord = 4;

template <typename T>
T At(std::span<const std::byte> message, std::size_t place) {
  static_assert(std::is_trivially_copyable_v<T>);
  T value;
  std::memcpy(&value, message.data() + place, sizeof value);
  return value;
}

}  // namespace

std::optional<RequestView> ReadRequest(std::span<const std::byte> bytes) {
  if (bytes.size() < kEncoding + kParameter + kWord) return std::nullopt;
  const std::span<const std::byte> message = bytes.subspan(kEncoding);
  const std::size_t length = At<std::uint32_t>(message, kParameter);
  const std::size_t begin = kParameter + kWord;
  if (length > message.size() - begin) return std::nullopt;
  const std::size_t binary = (begin + length + kWord - 1) / kWord * kWord;
  if (binary + kWord > message.size()) return std::nullopt;
  const auto* text = reinterpret_cast<const char*>(message.data() + begin);
  std::string_view parameter(text, length == 0 ? 0 : length - 1);
  // What is longer is refused anyway.
  if (parameter.size() <= kMostParameterBytes)
    parameter = parameter.substr(0, parameter.find('\0'));
  return RequestView{.id = At<std::int64_t>(message, kId),
                     .api_id = At<std::int64_t>(message, kApi),
                     .lease_id = At<std::int64_t>(message, kLease),
                     .priority = At<std::int32_t>(message, kPriority),
                     .noreply = message[kNoreply] != std::byte{0},
                     .parameter = parameter,
                     .binary_bytes = At<std::uint32_t>(message, binary)};
}

}  // namespace understudy::services
