// The checksum that closes the vendor's low-level messages.
#pragma once

#include <cstdint>
#include <span>

namespace understudy::wire {

// CRC of 32-bit words, each taken from its most significant bit: polynomial 0x04C11DB7, start value
// 0xFFFFFFFF, nothing reflected, no final xor (CRC-32/MPEG-2 over the words' bytes, high byte
// first; unitree_sdk2 dds_wrapper/common/crc.h). 0xFFFFFFFF for no words.
std::uint32_t Crc32(std::span<const std::uint32_t> words);

}  // namespace understudy::wire
