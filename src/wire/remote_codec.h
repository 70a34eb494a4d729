// Encodes the remote controller, in the same way for both families.
#pragma once

#include <array>
#include <cstdint>

#include "idl/unitree_go.h"
#include "robot/robot_values.h"

namespace understudy::wire {

// Returns LowState.wireless_remote: head 55 51 (public notes on a real G1), keys, lx, rx, ry, L2,
// ly (unitree_sdk2 dds_wrapper/common/unitree_joystick.hpp), 16 zero bytes. L2 as a number is 0 or
// 1 (*assumed*). All bytes are zero while the remote is off, as captured on Go2 and G1.
std::array<std::uint8_t, 40> EncodeRemote(const robot::RemoteReading& remote);

// rt/wirelesscontroller.
void EncodeRemote(const robot::RemoteReading& remote,
                  unitree_go_msg_dds__WirelessController_* message);

}  // namespace understudy::wire
