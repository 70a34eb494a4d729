// The robot port of the unitree_go family.
#ifndef UNDERSTUDY_WIRE_GO_PORT_H_
#define UNDERSTUDY_WIRE_GO_PORT_H_

#include <cstdint>
#include <optional>

#include "bus/reader.h"
#include "bus/writer.h"
#include "idl/unitree_go.h"
#include "robot/robot_spec.h"
#include "wire/motion_codec.h"
#include "wire/robot_port.h"

namespace understudy::wire {

// Reads rt/lowcmd and, where the robot has one, rt/arm_sdk; writes rt/lowstate, rt/sportmodestate,
// their rt/lf/ twins and, while a remote controller is there, rt/wirelesscontroller. Hands are
// hg's.
class GoPort final : public RobotPort {
 public:
  // `spec` and `participant` must outlive the port. Throws BusError when Cyclone refuses and
  // ModelError when the robot does not fit into the messages.
  GoPort(const bus::Participant& participant, const robot::RobotSpec& spec);

  bool TakeCommand(robot::RobotCommand* command, robot::Refusal* wire) override;
  bool TakeArmCommand(robot::RobotCommand* command, double* weight) override;
  bool TakeUserCommand(robot::RobotCommand* command) override;
  bool TakeHandCommand(std::size_t, robot::HandCommand*, robot::Refusal*) override { return false; }
  void Publish(const robot::RobotState& state, const Due& due) override;
  int command_writers() override { return commands_.matched_writers(); }
  robot::PortCounts counts() const override;

 private:
  const robot::RobotSpec& spec_;
  MotionFields motion_fields_;
  bus::Reader<unitree_go_msg_dds__LowCmd_> commands_;
  std::optional<bus::Reader<unitree_go_msg_dds__LowCmd_>> arm_commands_;
  bus::Writer<unitree_go_msg_dds__LowState_> lowstate_;
  bus::Writer<unitree_go_msg_dds__LowState_> lf_lowstate_;
  bus::Writer<unitree_go_msg_dds__SportModeState_> motion_;
  bus::Writer<unitree_go_msg_dds__SportModeState_> lf_motion_;
  bus::Writer<unitree_go_msg_dds__WirelessController_> remote_;
  unitree_go_msg_dds__LowState_ lowstate_message_{};
  unitree_go_msg_dds__SportModeState_ motion_message_{};
  unitree_go_msg_dds__WirelessController_ remote_message_{};
  robot::PortCounts counts_;
};

}  // namespace understudy::wire

#endif  // UNDERSTUDY_WIRE_GO_PORT_H_
