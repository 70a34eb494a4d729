// The command that the vendor's Go2 examples fill in before they move anything.
#pragma once

#include "idl/unitree_go.h"

namespace understudy::wire {

// All 20 slots on, without position, velocity, torque or gains. Its crc is 0.
inline unitree_go_msg_dds__LowCmd_ InitialGoCommand() {
  unitree_go_msg_dds__LowCmd_ message{};
  message.head[0] = 0xFE;
  message.head[1] = 0xEF;
  message.level_flag = 0xFF;
  for (auto& motor : message.motor_cmd) {
    motor.mode = 1;
    motor.q = 2.146e9F;
    motor.dq = 16000.0F;
  }
  return message;
}

}  // namespace understudy::wire
