// Bytes as LowCmd of both families and as HandCmd: what is taken is finite and has no negative
// gain.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "authority/command_gate.h"
#include "authority/intake.h"
#include "tests/wire/robots.h"
#include "wire/go_codec.h"
#include "wire/hand_codec.h"
#include "wire/hg_codec.h"
#include "wire/slots.h"

namespace understudy {
namespace {

// Offers a command as the router does; `lenient` takes faults of form.
void Offer(const robot::RobotCommand& command, robot::Refusal form, bool lenient) {
  if (form == robot::Refusal::kMotorCount) return;  // left unchanged
  const robot::RobotCommand start{.motors =
                                      std::vector<robot::MotorCommand>(command.motors.size())};
  authority::CommandGate gate({}, start);
  authority::Intake intake(lenient);
  const robot::Refusal refusal = intake.Judge(form, [&] { return gate.Offer(command, 0); });
  if (refusal != robot::Refusal::kNone) return;
  if (authority::HarmIn(gate.Current(0)) != robot::Refusal::kNone) std::abort();
}

template <typename LowCmd>
void Try(const std::uint8_t* data, std::size_t size, const robot::RobotSpec& spec) {
  LowCmd message{};
  std::memcpy(&message, data, std::min(size, sizeof message));
  robot::RobotCommand command = wire::CommandOf(spec);
  Offer(command, wire::Decode(message, spec, &command), size % 2 == 0);
  Offer(command, wire::DecodeUnsigned(message, spec, &command), false);
  const wire::UnusedSlots unused = wire::UnusedSlotCommands(message, spec);
  if (unused.differ && unused.count == 0) std::abort();
}

void TryHand(const std::uint8_t* data, std::size_t size) {
  using MotorCmd = unitree_hg_msg_dds__MotorCmd_;
  static const robot::HandSpec spec{.motors = {{.joint = "a"}, {.joint = "b"}, {.joint = "c"}}};
  std::vector<MotorCmd> motors(std::min<std::size_t>(size / sizeof(MotorCmd), 16));
  if (!motors.empty()) std::memcpy(motors.data(), data, motors.size() * sizeof(MotorCmd));
  unitree_hg_msg_dds__HandCmd_ message{};
  message.motor_cmd._length = message.motor_cmd._maximum =
      static_cast<std::uint32_t>(motors.size());
  message.motor_cmd._buffer = motors.data();
  robot::RobotCommand command{.motors = std::vector<robot::MotorCommand>(spec.motors.size())};
  Offer(command, wire::Decode(message, spec, &command), false);
}

}  // namespace
}  // namespace understudy

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace understudy;  // NOLINT(google-build-using-namespace)
  Try<unitree_go_msg_dds__LowCmd_>(data, size, wire::GoRobot());
  Try<unitree_hg_msg_dds__LowCmd_>(data, size, wire::HgRobot());
  TryHand(data, size);
  return 0;
}
