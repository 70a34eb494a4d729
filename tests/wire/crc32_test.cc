#include <cstdint>
#include <random>
#include <vector>

#include <gmock/gmock.h>

#include "wire/message_crc.h"

namespace understudy::wire {
namespace {

// The definition, bit by bit.
std::uint32_t ByDefinition(const std::vector<std::uint32_t>& words) {
  std::uint32_t crc = 0xFFFFFFFF;
  for (const std::uint32_t word : words) {
    for (int bit = 31; bit >= 0; --bit) {
      const bool out = (crc >> 31) != 0;
      crc <<= 1;
      if (out != ((word >> bit & 1) != 0)) crc ^= 0x04C11DB7;
    }
  }
  return crc;
}

TEST(Crc32Test, IsTheStartValueForNoWords) { EXPECT_EQ(Crc32({}), 0xFFFFFFFF); }

TEST(Crc32Test, EqualsItsDefinitionForEveryLength) {
  std::mt19937 random(1);
  std::vector<std::uint32_t> words;
  for (int length = 0; length < 70; ++length) {
    EXPECT_EQ(Crc32(words), ByDefinition(words)) << length << " words";
    words.push_back(static_cast<std::uint32_t>(random()));
  }
}

TEST(Crc32Test, SeesEverySingleBit) {
  const std::vector<std::uint32_t> zeros(9);
  for (std::size_t bit = 0; bit < 9 * 32; ++bit) {
    std::vector<std::uint32_t> words = zeros;
    words[bit / 32] ^= 1U << bit % 32;
    EXPECT_NE(Crc32(words), Crc32(zeros)) << "bit " << bit;
  }
}

}  // namespace
}  // namespace understudy::wire
