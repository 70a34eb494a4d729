// The robot's own address, lent to a card of this computer (`run --as-robot`).
#pragma once

#include <string>
#include <thread>

#include <netinet/in.h>

namespace understudy::exec {

// While it lives an interface has kRobotAddress/24 beside its other addresses. A thread renews it,
// since the kernel takes it back after kAddressLifetime: also when this process was killed.
class RobotAddress {
 public:
  // Asks the cable for 0.3 s whether somebody there has the address. Throws BusError if so, if this
  // computer has it already, if the interface is not there or `lo`, or without the rights
  // CAP_NET_ADMIN and CAP_NET_RAW.
  explicit RobotAddress(const std::string& interface);
  ~RobotAddress();

  RobotAddress(const RobotAddress&) = delete;
  RobotAddress& operator=(const RobotAddress&) = delete;

 private:
  unsigned index_;
  std::jthread renewal_;
};

inline constexpr unsigned kAddressLifetime = 60;  // s, *assumed*

}  // namespace understudy::exec
