// Topics of a Go2 that change a setting.
#pragma once

#include <atomic>
#include <vector>

#include "authority/motor_owner.h"
#include "bus/participant.h"
#include "bus/reader.h"
#include "idl/std_msgs.h"
#include "idl/unitree_go.h"
#include "services/service.h"
#include "services/service_port.h"

namespace understudy::services {

// Settings of a Go2 that a message changes instead of a request (docs/dev/sources.md#topics):
//   rt/utlidar/switch  String_ "ON" or "OFF": the program unitree_lidar. That robot_state then
//                      lists it so is assumed.
//   rt/uwbswitch       UwbSwitch_: what uwbswitch SwitchSet sets.
class SwitchTopics {
 public:
  // Throws BusError. `uwb_switch` and `mail`, which is raised when a message has arrived, must
  // outlive this.
  SwitchTopics(const bus::Participant& participant, Service* uwb_switch, std::atomic<bool>* mail);

  // Takes the waiting messages. Words other than ON and OFF change nothing and are added to `calls`
  // as refused.
  void Poll(authority::MotorOwner* owner, std::vector<Call>* calls);

 private:
  Service* uwb_switch_;
  bus::Reader<std_msgs_msg_dds__String_> lidar_;
  bus::Reader<unitree_go_msg_dds__UwbSwitch_> uwb_;
};

}  // namespace understudy::services
