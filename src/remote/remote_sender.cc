#include "remote/remote_sender.h"

#include "robot/remote_keys.h"

namespace understudy::remote {
namespace {

bool Same(const robot::RemoteReading& one, const robot::RemoteReading& other) {
  return one.keys == other.keys && one.lx == other.lx && one.ly == other.ly && one.rx == other.rx &&
         one.ry == other.ry;
}

}  // namespace

void RemoteSender::Hold(const robot::RemoteReading& reading, double t) {
  if (told_any_ && t - told_at_ < kLeastPeriod) return;
  const bool renew = !Same(reading, robot::RemoteReading{}) && t - told_at_ >= kRenewEvery;
  if (!told_any_ || renew || !Same(reading, told_)) Tell(reading, t);
}

void RemoteSender::LetGo(double t) {
  if (told_any_ && !Same(told_, robot::RemoteReading{})) Tell(robot::RemoteReading{}, t);
}

void RemoteSender::Tell(const robot::RemoteReading& reading, double t) {
  told_ = reading;
  told_at_ = t;
  told_any_ = true;
  send_(reading, kLetGoAfter * speed_);
}

nlohmann::json ValuesOf(const robot::RemoteReading& reading, double seconds) {
  return {{"keys", robot::RemoteKeyNames(reading.keys)},
          {"lx", reading.lx},
          {"ly", reading.ly},
          {"rx", reading.rx},
          {"ry", reading.ry},
          {"for", seconds}};
}

}  // namespace understudy::remote
