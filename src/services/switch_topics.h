// Switches that are thrown by a message instead of a request.
#pragma once

#include "bus/reader.h"
#include "idl/std_msgs.h"
#include "idl/unitree_go.h"
#include "services/service.h"

namespace understudy::services {

// Of a Go2 (docs/sources.md#topics):
//   rt/utlidar/switch  String_ "ON" or "OFF": the program unitree_lidar. That robot_state then
//                      lists it so is assumed; no lidar is modelled.
//   rt/uwbswitch       UwbSwitch_: what uwbswitch SwitchSet sets.
class SwitchTopics {
 public:
  // Throws BusError. `uwb_switch` must outlive this.
  SwitchTopics(const bus::Participant& participant, Service* uwb_switch);

  // Takes what waits. Other words than ON and OFF change nothing.
  void Poll(authority::MotorOwner* owner);

 private:
  Service* uwb_switch_;
  bus::Reader<std_msgs_msg_dds__String_> lidar_;
  bus::Reader<unitree_go_msg_dds__UwbSwitch_> uwb_;
};

}  // namespace understudy::services
