#include "robot/refusal_text.h"

namespace understudy::robot {

std::string_view Explain(Refusal refusal) {
  switch (refusal) {
    case Refusal::kCrc:
      return "its crc does not fit its content; fill crc last, over everything before it";
    case Refusal::kHead:
      return "head must be FE EF and level_flag FF";
    case Refusal::kModeMachine:
      return "mode_machine must repeat the one in LowState";
    case Refusal::kModePr:
      return "mode_pr must be 0 (PR) or 1 (AB)";
    case Refusal::kMotorMode:
      return "a motor's mode byte has a value that this robot does not know";
    case Refusal::kMotorCount:
      return "motor_cmd does not hold exactly one entry per motor";
    case Refusal::kNotFinite:
      return "a motor's q, dq, tau, kp or kd is not a finite number";
    case Refusal::kGain:
      return "a motor's kp or kd is negative";
    case Refusal::kMotionService:
      return "the robot's own motion service moves the motors; release it (MotionSwitcherClient "
             "ReleaseMode), or start with --released";
    case Refusal::kNoMotionService:
      return "it has an effect only while a motion service is on, and none is; start one "
             "(MotionSwitcherClient SelectMode) or command by rt/lowcmd";
    case Refusal::kNotHandedOver:
      return "the motion service has not handed the motors over; LocoClient SwitchToUserCtrl does";
    case Refusal::kDamping:
      return "it has no effect while the motion service damps; have the robot stand (LocoClient "
             "SetFsmId), then send the weight anew";
    case Refusal::kUndecoded:
      return "its bytes are not a message of the topic's type; was the program built with the "
             "vendor's IDL?";
    case Refusal::kLost:
      return "more came than the robot reads, 8 of a topic in a tick, and newer ones replaced them";
    case Refusal::kUnmatched:
      return "the writer's type or quality of service does not match the topic: nothing of it "
             "arrives";
    case Refusal::kNone:
    case Refusal::kCount:
      break;
  }
  return {};
}

std::string_view ExplainForHand(Refusal refusal) {
  if (refusal == Refusal::kNoMotionService) {
    return "rt/hand_sdk has an effect only while a motion service is on, and none is; start one "
           "(MotionSwitcherClient SelectMode) or command the hands by topics of their own";
  }
  if (refusal != Refusal::kMotorMode) return Explain(refusal);
  return "mode of motor_cmd[i] must be i + 16 to follow or i to lock, and 128 more to have the "
         "motor lock by itself when commands stop";
}

}  // namespace understudy::robot
