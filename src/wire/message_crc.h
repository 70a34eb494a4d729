// The CRC of whole messages.
#pragma once

#include <cstdint>
#include <span>

#include "idl/unitree_go.h"
#include "idl/unitree_hg.h"

namespace understudy::wire {

// What the message's crc field has to be: Crc32 over all words before it, in the native layout of
// the vendor's C++ object (offsets: docs/sources.md#crc), with zeros in the gaps between
// fields. The present crc field does not matter. About 1 µs for the largest, hg LowState.
//
// The vendor's C++ sums up its object as it lies in memory, gaps included. Value-initialised
// objects have zeros there. A client that leaves garbage there sends a crc that nobody can check,
// since the gaps are not part of the message: it is refused like any other wrong one.
std::uint32_t MessageCrc(const unitree_go_msg_dds__LowCmd_& message);
std::uint32_t MessageCrc(const unitree_go_msg_dds__LowState_& message);
std::uint32_t MessageCrc(const unitree_hg_msg_dds__LowCmd_& message);
std::uint32_t MessageCrc(const unitree_hg_msg_dds__LowState_& message);

// CRC of 32-bit words, each taken from its most significant bit: polynomial 0x04C11DB7, start value
// 0xFFFFFFFF, nothing reflected, no final xor (CRC-32/MPEG-2 over the words' bytes, high byte
// first; unitree_sdk2 dds_wrapper/common/crc.h). 0xFFFFFFFF for no words.
std::uint32_t Crc32(std::span<const std::uint32_t> words);

}  // namespace understudy::wire
