// The robot port of the unitree_hg family.
#ifndef UNDERSTUDY_WIRE_HG_PORT_H_
#define UNDERSTUDY_WIRE_HG_PORT_H_

#include <cstdint>
#include <optional>

#include "bus/reader.h"
#include "bus/writer.h"
#include "idl/unitree_go.h"
#include "idl/unitree_hg.h"
#include "robot/robot_spec.h"
#include "wire/robot_port.h"

namespace understudy {

// Reads rt/lowcmd; writes rt/lowstate, rt/odommodestate, rt/secondary_imu where the robot has one,
// their rt/lf/ twins, and rt/lf/bmsstate, which has no fast twin.
class HgPort final : public RobotPort {
 public:
  // `spec` and `participant` must outlive the port. Throws BusError when Cyclone refuses and
  // ModelError when the robot does not fit into the messages.
  HgPort(const Participant& participant, const RobotSpec& spec);

  bool TakeCommand(RobotCommand* command, Refusal* wire) override;
  void Publish(const RobotState& state, const Due& due) override;
  int command_writers() override { return commands_.matched_writers(); }
  PortCounts counts() const override;

 private:
  struct SecondaryImu {
    Writer<unitree_hg_msg_dds__IMUState_> imu;
    Writer<unitree_hg_msg_dds__IMUState_> lf_imu;
    unitree_hg_msg_dds__IMUState_ message{};
  };

  const RobotSpec& spec_;
  Reader<unitree_hg_msg_dds__LowCmd_> commands_;
  Writer<unitree_hg_msg_dds__LowState_> lowstate_;
  Writer<unitree_hg_msg_dds__LowState_> lf_lowstate_;
  Writer<unitree_go_msg_dds__SportModeState_> motion_;
  Writer<unitree_go_msg_dds__SportModeState_> lf_motion_;
  Writer<unitree_hg_msg_dds__BmsState_> lf_bms_;
  std::optional<SecondaryImu> secondary_;
  unitree_hg_msg_dds__LowState_ lowstate_message_{};
  unitree_go_msg_dds__SportModeState_ motion_message_{};
  unitree_hg_msg_dds__BmsState_ bms_message_{};
  PortCounts counts_;
};

}  // namespace understudy

#endif  // UNDERSTUDY_WIRE_HG_PORT_H_
