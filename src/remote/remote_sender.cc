#include "remote/remote_sender.h"

#include <unistd.h>

#include "robot/remote_keys.h"

namespace understudy::remote {
namespace {

bool Same(const robot::RemoteReading& one, const robot::RemoteReading& other) {
  return one.keys == other.keys && one.lx == other.lx && one.ly == other.ly && one.rx == other.rx &&
         one.ry == other.ry;
}

}  // namespace

std::int64_t FirstPress() {
  constexpr std::int64_t kApart = 20;  // the most pids, 2^22, times this are valid numbers
  return ::getpid() * kApart;
}

void RemoteSender::Hold(const robot::RemoteReading& reading, double t) {
  if (told_any_ && t - told_at_ < kLeastPeriod) return;
  const bool renew = !Same(reading, robot::RemoteReading{}) && t - told_at_ >= kRenewEvery;
  if (!told_any_ || renew || !Same(reading, told_)) Tell(reading, t);
}

void RemoteSender::LetGo(double t) {
  if (told_any_ && !Same(told_, robot::RemoteReading{})) Tell(robot::RemoteReading{}, t);
}

void RemoteSender::Tell(const robot::RemoteReading& reading, double t) {
  if ((reading.keys & ~told_.keys) != 0) ++press_;
  told_ = reading;
  told_at_ = t;
  told_any_ = true;
  send_({{"keys", robot::RemoteKeyNames(reading.keys)},
         {"lx", reading.lx},
         {"ly", reading.ly},
         {"rx", reading.rx},
         {"ry", reading.ry},
         {"for", kLetGoAfter * speed_},
         {"press", press_}});
}

}  // namespace understudy::remote
