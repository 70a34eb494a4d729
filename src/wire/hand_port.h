// The topics of one hand.
#ifndef UNDERSTUDY_WIRE_HAND_PORT_H_
#define UNDERSTUDY_WIRE_HAND_PORT_H_

#include <cstdint>

#include "bus/reader.h"
#include "bus/writer.h"
#include "idl/unitree_hg.h"
#include "robot/robot_spec.h"
#include "wire/hand_codec.h"
#include "wire/robot_port.h"

namespace understudy::wire {

// Reads rt/<topic>/cmd; writes rt/<topic>/state and its twin rt/lf/<topic>/state, for HandSpec's
// topic. A part of HgPort.
class HandPort {
 public:
  // `spec` and `participant` must outlive the port. Throws BusError when Cyclone refuses and
  // ModelError when the hand has more motors or a pad other taxels than the messages have room for.
  HandPort(const bus::Participant& participant, const robot::HandSpec& spec);

  // As RobotPort::TakeHandCommand.
  bool Take(robot::HandCommand* command, robot::Refusal* wire);
  void Publish(const robot::HandReading& reading, const Due& due);

  std::uint64_t failures() const { return state_.failures() + lf_state_.failures(); }

 private:
  const robot::HandSpec* spec_;
  bus::Reader<unitree_hg_msg_dds__HandCmd_> commands_;
  bus::Writer<unitree_hg_msg_dds__HandState_> state_;
  bus::Writer<unitree_hg_msg_dds__HandState_> lf_state_;
  HandStateMessage message_;
};

}  // namespace understudy::wire

#endif  // UNDERSTUDY_WIRE_HAND_PORT_H_
