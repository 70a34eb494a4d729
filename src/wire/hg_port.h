// The robot port of the unitree_hg family.
#ifndef UNDERSTUDY_WIRE_HG_PORT_H_
#define UNDERSTUDY_WIRE_HG_PORT_H_

#include <cstdint>
#include <optional>
#include <vector>

#include "bus/reader.h"
#include "bus/writer.h"
#include "idl/std_msgs.h"
#include "idl/unitree_go.h"
#include "idl/unitree_hg.h"
#include "robot/robot_spec.h"
#include "wire/hand_port.h"
#include "wire/motion_codec.h"
#include "wire/robot_port.h"

namespace understudy::wire {

// Reads rt/lowcmd and, where the robot has them, rt/arm_sdk and rt/user_lowcmd; writes rt/lowstate,
// rt/odommodestate, rt/secondary_imu where the robot has one, their rt/lf/ twins, rt/lf/bmsstate
// and rt/lf/mainboardstate, which have no fast twin, and rt/wirelesscontroller while a remote
// controller is there. Where firmware tells the state machine's id, rt/sportmodestate and its twin
// while a motion service is on; G1 rt/arm/action/state then too. Hands have topics of their own
// (HandPort).
//
// No page documents what is in MainBoardState_: it is all 0.
class HgPort final : public RobotPort {
 public:
  // `spec` and `participant` must outlive the port. Throws BusError when Cyclone refuses and
  // ModelError when the robot does not fit into the messages.
  HgPort(const bus::Participant& participant, const robot::RobotSpec& spec);

  bool TakeCommand(robot::RobotCommand* command, robot::Refusal* wire) override;
  bool TakeArmCommand(robot::RobotCommand* command, double* weight) override;
  bool TakeUserCommand(robot::RobotCommand* command) override;
  bool TakeHandCommand(std::size_t hand, robot::HandCommand* command,
                       robot::Refusal* wire) override;
  void Publish(const robot::RobotState& state, const Due& due) override;
  int command_writers() override { return commands_.matched_writers(); }
  robot::PortCounts counts() const override;

 private:
  struct SecondaryImu {
    bus::Writer<unitree_hg_msg_dds__IMUState_> imu;
    bus::Writer<unitree_hg_msg_dds__IMUState_> lf_imu;
    unitree_hg_msg_dds__IMUState_ message{};
  };

  struct Fsm {
    bus::Writer<unitree_hg_msg_dds__SportModeState_> state;
    bus::Writer<unitree_hg_msg_dds__SportModeState_> lf_state;
    unitree_hg_msg_dds__SportModeState_ message{};
  };

  void PublishSecondaryImu(const robot::ImuReading& reading, const Due& due);
  void PublishService(const robot::RobotState& state, const Due& due);

  const robot::RobotSpec& spec_;
  MotionFields motion_fields_;
  bus::Reader<unitree_hg_msg_dds__LowCmd_> commands_;
  std::optional<bus::Reader<unitree_hg_msg_dds__LowCmd_>> arm_commands_;
  std::optional<bus::Reader<unitree_hg_msg_dds__LowCmd_>> user_commands_;
  bus::Writer<unitree_hg_msg_dds__LowState_> lowstate_;
  bus::Writer<unitree_hg_msg_dds__LowState_> lf_lowstate_;
  bus::Writer<unitree_go_msg_dds__SportModeState_> motion_;
  bus::Writer<unitree_go_msg_dds__SportModeState_> lf_motion_;
  bus::Writer<unitree_hg_msg_dds__BmsState_> lf_bms_;
  bus::Writer<unitree_hg_msg_dds__MainBoardState_> lf_board_;
  bus::Writer<unitree_go_msg_dds__WirelessController_> remote_;
  std::optional<SecondaryImu> secondary_;
  std::optional<Fsm> fsm_;
  std::optional<bus::Writer<std_msgs_msg_dds__String_>> arm_action_;
  std::vector<HandPort> hands_;
  unitree_hg_msg_dds__LowState_ lowstate_message_{};
  unitree_go_msg_dds__SportModeState_ motion_message_{};
  unitree_hg_msg_dds__BmsState_ bms_message_{};
  unitree_go_msg_dds__WirelessController_ remote_message_{};
  robot::PortCounts counts_;
};

}  // namespace understudy::wire

#endif  // UNDERSTUDY_WIRE_HG_PORT_H_
