#include "wire/crc32.h"

#include <array>

namespace understudy::wire {
namespace {

constexpr std::uint32_t kPolynomial = 0x04C11DB7;
constexpr std::size_t kWordsAtOnce = 4;
constexpr std::size_t kTables = 4 * kWordsAtOnce;

using Tables = std::array<std::array<std::uint32_t, 256>, kTables>;

// kTable[n][b]: what byte b adds to the register when n more bytes follow it in its group of words
// ("slicing by 16"). One look-up per byte, none of which waits for another.
constexpr Tables kTable = [] {
  Tables tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t crc = byte << 24;
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc << 1) ^ ((crc & 0x80000000U) != 0 ? kPolynomial : 0);
    }
    tables[0][byte] = crc;
  }
  for (std::size_t n = 1; n < kTables; ++n) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t crc = tables[n - 1][byte];
      tables[n][byte] = (crc << 8) ^ tables[0][crc >> 24];
    }
  }
  return tables;
}();

// What a word adds when `after` words follow it in its group. Left to itself, -O2 makes this a call
// and the whole take twice as long.
[[gnu::always_inline]] inline std::uint32_t Slice(std::uint32_t word, std::size_t after) {
  return kTable[4 * after + 3][word >> 24] ^ kTable[4 * after + 2][(word >> 16) & 0xFF] ^
         kTable[4 * after + 1][(word >> 8) & 0xFF] ^ kTable[4 * after][word & 0xFF];
}

}  // namespace

std::uint32_t Crc32(std::span<const std::uint32_t> words) {
  std::uint32_t crc = 0xFFFFFFFF;
  std::size_t i = 0;
  for (; i + kWordsAtOnce <= words.size(); i += kWordsAtOnce) {
    crc = Slice(crc ^ words[i], 3) ^ Slice(words[i + 1], 2) ^ Slice(words[i + 2], 1) ^
          Slice(words[i + 3], 0);
  }
  for (; i < words.size(); ++i) crc = Slice(crc ^ words[i], 0);
  return crc;
}

}  // namespace understudy::wire
