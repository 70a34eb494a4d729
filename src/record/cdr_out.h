// Appends the values of a message in little-endian XCDR1, behind the four bytes of the encoding.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "record/bytes.h"

namespace understudy::record {

inline constexpr std::size_t kCdrHead = 4;
inline constexpr std::array<std::byte, kCdrHead> kLittleEndian = {std::byte{0}, std::byte{1},
                                                                  std::byte{0}, std::byte{0}};

// Begins a message in `out`, which is overwritten.
inline void PutCdrHead(BytesOut* out) {
  out->clear();
  out->PutRaw(kLittleEndian);
}

template <typename Number>
void PutNumber(Number number, BytesOut* out) {
  out->Align(sizeof(number), kCdrHead);
  out->Put(number);
}

// The length of a sequence, whose elements follow.
inline void PutCount(std::size_t count, BytesOut* out) {
  PutNumber(static_cast<std::uint32_t>(count), out);
}

// A sequence.
inline void PutNumbers(const std::vector<double>& numbers, BytesOut* out) {
  PutCount(numbers.size(), out);
  if (numbers.empty()) return;
  out->Align(sizeof(double), kCdrHead);
  out->PutRaw(std::as_bytes(std::span(numbers)));
}

// A string, with its terminating zero.
inline void PutText(std::string_view text, BytesOut* out) {
  PutCount(text.size() + 1, out);
  out->PutRaw(AsBytes(text));
  out->Put(std::uint8_t{0});
}

}  // namespace understudy::record
