#include "remote/remote_sender.h"

namespace understudy {
namespace {

bool Same(const RemoteReading& one, const RemoteReading& other) {
  return one.keys == other.keys && one.lx == other.lx && one.ly == other.ly && one.rx == other.rx &&
         one.ry == other.ry;
}

}  // namespace

void RemoteSender::Hold(const RemoteReading& reading, double t) {
  if (told_any_ && t - told_at_ < kLeastPeriod) return;
  const bool renew = !Same(reading, RemoteReading{}) && t - told_at_ >= kRenewEvery;
  if (!told_any_ || renew || !Same(reading, told_)) Tell(reading, t);
}

void RemoteSender::LetGo(double t) {
  if (told_any_ && !Same(told_, RemoteReading{})) Tell(RemoteReading{}, t);
}

void RemoteSender::Tell(const RemoteReading& reading, double t) {
  told_ = reading;
  told_at_ = t;
  told_any_ = true;
  send_({.reading = reading, .seconds = kLetGoAfter * speed_});
}

}  // namespace understudy
