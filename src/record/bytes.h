// Writes and reads little-endian bytes in MCAP's encoding.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/errors.h"

namespace understudy::record {

static_assert(std::endian::native == std::endian::little);

using ByteSpan = std::span<const std::byte>;
using StringMap = std::map<std::string, std::string>;

inline ByteSpan AsBytes(std::string_view text) { return std::as_bytes(std::span(text)); }

// Appends values to a buffer.
class BytesOut {
 public:
  template <typename Number>
  void Put(Number number) {
    static_assert(std::is_arithmetic_v<Number>);
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof(number));
    std::memcpy(bytes_.data() + at, &number, sizeof(number));
  }
  void PutRaw(ByteSpan raw);
  // Strings and maps begin with their length in bytes, as uint32.
  void PutString(std::string_view text) {
    Put(static_cast<std::uint32_t>(text.size()));
    PutRaw(AsBytes(text));
  }
  void PutMap(const StringMap& map) {
    BytesOut entries;
    for (const auto& [key, value] : map) {
      entries.PutString(key);
      entries.PutString(value);
    }
    Put(static_cast<std::uint32_t>(entries.size()));
    PutRaw(entries.span());
  }
  // Appends zeros until the size after `from` is a multiple of `alignment`.
  void Align(std::size_t alignment, std::size_t from = 0) {
    const std::size_t over = (bytes_.size() - from) % alignment;
    if (over != 0) bytes_.resize(bytes_.size() + alignment - over);
  }

  std::size_t size() const { return bytes_.size(); }
  bool empty() const { return bytes_.empty(); }
  void clear() { bytes_.clear(); }  // keeps the memory
  ByteSpan span() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

// Reads values from the front. Reading beyond the end throws RecordError.
class BytesIn {
 public:
  explicit BytesIn(ByteSpan bytes) : bytes_(bytes) {}

  template <typename Number>
  Number Take() {
    static_assert(std::is_arithmetic_v<Number>);
    Number number;
    std::memcpy(&number, TakeRaw(sizeof(number)).data(), sizeof(number));
    return number;
  }
  ByteSpan TakeRaw(std::uint64_t size) {
    if (size > remaining()) {
      throw RecordError("expected " + std::to_string(size) + " bytes and found " +
                        std::to_string(remaining()));
    }
    const ByteSpan raw = bytes_.subspan(at_, static_cast<std::size_t>(size));
    at_ += raw.size();
    return raw;
  }
  std::string TakeString() {
    const ByteSpan raw = TakeRaw(Take<std::uint32_t>());
    return {reinterpret_cast<const char*>(raw.data()), raw.size()};
  }
  StringMap TakeMap() {
    BytesIn entries(TakeRaw(Take<std::uint32_t>()));
    StringMap map;
    while (entries.remaining() > 0) {
      std::string key = entries.TakeString();
      map[std::move(key)] = entries.TakeString();
    }
    return map;
  }
  void Align(std::size_t alignment, std::size_t from = 0) {
    const std::size_t over = (at_ - from) % alignment;
    if (over != 0) TakeRaw(alignment - over);
  }

  std::size_t remaining() const { return bytes_.size() - at_; }
  std::size_t position() const { return at_; }

 private:
  ByteSpan bytes_;
  std::size_t at_ = 0;
};

}  // namespace understudy::record
