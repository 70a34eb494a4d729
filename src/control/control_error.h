// What can go wrong between a running robot and those who ask something of it.
#ifndef UNDERSTUDY_CONTROL_CONTROL_ERROR_H_
#define UNDERSTUDY_CONTROL_CONTROL_ERROR_H_

#include "robot/errors.h"

namespace understudy {

// The control folder or socket cannot be used, no robot is there, or it refused.
class ControlError : public SetupError {
 public:
  using SetupError::SetupError;
};

}  // namespace understudy

#endif  // UNDERSTUDY_CONTROL_CONTROL_ERROR_H_
