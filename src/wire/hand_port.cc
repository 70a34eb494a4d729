#include "wire/hand_port.h"

#include <iterator>
#include <string>

#include "base/errors.h"

namespace understudy::wire {
namespace {

// What is wrong with the hand throws, before memory is laid out by it.
const robot::HandSpec& Checked(const robot::HandSpec& spec) {
  if (spec.motors.size() > kHandIds) {
    throw ModelError("hand " + spec.name + " has " + std::to_string(spec.motors.size()) +
                     " motors, the mode byte tells " + std::to_string(kHandIds) + " apart");
  }
  constexpr double kTaxels = std::size(unitree_hg_msg_dds__PressSensorState_{}.pressure);
  for (const robot::PadSpec& pad : spec.pads) {
    for (const double taxel : pad.taxels) {
      if (taxel >= 0 && taxel < kTaxels) continue;
      throw ModelError("hand " + spec.name + " has a pad with a taxel beyond 0..11");
    }
  }
  return spec;
}

bus::Topic<unitree_hg_msg_dds__HandState_> State(const std::string& name) {
  return {name.c_str(), &unitree_hg_msg_dds__HandState__desc};
}

}  // namespace

HandPort::HandPort(const bus::Participant& participant, const robot::HandSpec& spec)
    : spec_(&Checked(spec)),
      commands_(participant,
                bus::Topic<unitree_hg_msg_dds__HandCmd_>{("rt/" + spec.topic + "/cmd").c_str(),
                                                         &unitree_hg_msg_dds__HandCmd__desc}),
      state_(participant, State("rt/" + spec.topic + "/state")),
      lf_state_(participant, State("rt/lf/" + spec.topic + "/state")),
      message_(spec) {}

bool HandPort::Take(robot::HandCommand* command, robot::Refusal* wire) {
  const auto visit = [&](const unitree_hg_msg_dds__HandCmd_& message, bus::WriterHandle) {
    *wire = Decode(message, *spec_, command);
  };
  return commands_.Take(visit, 1) == 1;
}

void HandPort::Publish(const robot::HandReading& reading, const Due& due) {
  const bool hands = due.hands && state_.has_readers();
  const bool lf = due.lf && lf_state_.has_readers();
  if (hands || lf) message_.Encode(reading);
  if (hands) state_.Write(message_.message());
  if (lf) lf_state_.Write(message_.message());
}

}  // namespace understudy::wire
