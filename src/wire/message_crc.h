// Computes the CRC of messages.
#pragma once

#include <cstdint>
#include <span>

#include "idl/unitree_go.h"
#include "idl/unitree_hg.h"

namespace understudy::wire {

// Return the valid value of the message's crc field: Crc32 over all words before it, in the native
// layout of the vendor's C++ object (offsets: docs/dev/sources.md#crc), with zeros in the padding.
// Ignores the present crc field. Takes about 1 µs for the largest, hg LowState.
//
// The vendor's C++ computes it over the object in memory, including its padding, which is zero if
// the object is value-initialised. A client with garbage in the padding sends a crc that no
// receiver can verify, since the padding is not transmitted: it is refused as a wrong one.
std::uint32_t MessageCrc(const unitree_go_msg_dds__LowCmd_& message);
std::uint32_t MessageCrc(const unitree_go_msg_dds__LowState_& message);
std::uint32_t MessageCrc(const unitree_hg_msg_dds__LowCmd_& message);
std::uint32_t MessageCrc(const unitree_hg_msg_dds__LowState_& message);

// Returns the CRC of 32-bit words, most significant bit first: polynomial 0x04C11DB7, start value
// 0xFFFFFFFF, no reflection, no final xor (CRC-32/MPEG-2 over the words' bytes, high byte first;
// unitree_sdk2 dds_wrapper/common/crc.h). 0xFFFFFFFF for no words.
std::uint32_t Crc32(std::span<const std::uint32_t> words);

}  // namespace understudy::wire
