#include "wire/outlets.h"

#include "base/errors.h"
#include "idl/type_table.h"

namespace understudy::wire {

void Outlets::BeginTick(double t, std::span<const robot::LinkEffects> faults) {
  tick_.t = t;
  tick_.faults = faults;
  if (!tick_.any_late) return;
  tick_.any_late = false;
  for (const auto& outlet : outlets_) outlet->SendLate();
}

void Outlets::Clear() {
  for (const auto& outlet : outlets_) outlet->Clear();
  tick_.any_late = false;
}

const dds_topic_descriptor& Outlets::DescriptorOf(const RobotTopic& topic) {
  const MessageType* const type = FindMessageType(topic.type);
  if (type == nullptr)
    throw BusError("topic " + topic.name + ": no type " + std::string(topic.type));
  return *type->descriptor;
}

}  // namespace understudy::wire
