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

namespace understudy {

// Reads rt/lowcmd and, where the robot has one, rt/arm_sdk; writes rt/lowstate, rt/sportmodestate,
// their rt/lf/ twins and, while a remote controller is there, rt/wirelesscontroller. Hands are
// hg's.
class GoPort final : public RobotPort {
 public:
  // `spec` and `participant` must outlive the port. Throws BusError when Cyclone refuses and
  // ModelError when the robot does not fit into the messages.
  GoPort(const Participant& participant, const RobotSpec& spec);

  bool TakeCommand(RobotCommand* command, Refusal* wire) override;
  bool TakeArmCommand(RobotCommand* command, double* weight) override;
  bool TakeUserCommand(RobotCommand* command) override;
  bool TakeHandCommand(std::size_t, HandCommand*, Refusal*) override { return false; }
  void Publish(const RobotState& state, const Due& due) override;
  int command_writers() override { return commands_.matched_writers(); }
  PortCounts counts() const override;

 private:
  const RobotSpec& spec_;
  MotionFields motion_fields_;
  Reader<unitree_go_msg_dds__LowCmd_> commands_;
  std::optional<Reader<unitree_go_msg_dds__LowCmd_>> arm_commands_;
  Writer<unitree_go_msg_dds__LowState_> lowstate_;
  Writer<unitree_go_msg_dds__LowState_> lf_lowstate_;
  Writer<unitree_go_msg_dds__SportModeState_> motion_;
  Writer<unitree_go_msg_dds__SportModeState_> lf_motion_;
  Writer<unitree_go_msg_dds__WirelessController_> remote_;
  unitree_go_msg_dds__LowState_ lowstate_message_{};
  unitree_go_msg_dds__SportModeState_ motion_message_{};
  unitree_go_msg_dds__WirelessController_ remote_message_{};
  PortCounts counts_;
};

}  // namespace understudy

#endif  // UNDERSTUDY_WIRE_GO_PORT_H_
