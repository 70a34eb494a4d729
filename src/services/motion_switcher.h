// Says and changes which motion service moves the motors.
#ifndef UNDERSTUDY_SERVICES_MOTION_SWITCHER_H_
#define UNDERSTUDY_SERVICES_MOTION_SWITCHER_H_

#include "services/service.h"

namespace understudy {

// Service "motion_switcher" 1.0.0.1, the same on every robot (sdk_surface.md, section 3;
// hardware_contract.md, section 3):
//
//   1001 CheckMode    -> {"form":"0","name":""}    "" = no motion service moves the motors, LowCmd
//   does 1002 SelectMode   {"name":"ai"}                7001 bad parameter, 7004 unknown name, 7007
//   cannot be started 1003 ReleaseMode 1004 SetSilent    {"silent":true}              7001 bad
//   parameter 1005 GetSilent    -> {"silent":false}
//
// No motion service is on board yet, so SelectMode of a known name answers 7007 (select command
// failed): never a false success.
class MotionSwitcher final : public Service {
 public:
  std::string_view name() const override { return "motion_switcher"; }
  std::string_view api_version() const override { return "1.0.0.1"; }
  std::optional<ServiceReply> Handle(std::int64_t api_id, std::string_view parameter,
                                     RobotMode* mode) override;
};

}  // namespace understudy

#endif  // UNDERSTUDY_SERVICES_MOTION_SWITCHER_H_
