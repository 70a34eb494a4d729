// What can go wrong between a running robot and those who ask something of it.
#ifndef UNDERSTUDY_CONTROL_CONTROL_ERROR_H_
#define UNDERSTUDY_CONTROL_CONTROL_ERROR_H_

#include "robot/errors.h"

namespace understudy {

// No robot is there, or it refused.
class ControlError : public SetupError {
 public:
  using SetupError::SetupError;
};

// A name is none or is in use, or the folder or file of a control socket cannot be used.
class SocketError : public ControlError {
 public:
  using ControlError::ControlError;
};

}  // namespace understudy

#endif  // UNDERSTUDY_CONTROL_CONTROL_ERROR_H_
