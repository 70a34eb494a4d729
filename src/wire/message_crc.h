// The CRC of whole messages.
#pragma once

#include <cstdint>

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

}  // namespace understudy::wire
