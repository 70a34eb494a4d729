// Who moves the motors: the robot's own motion service or the programs that write rt/lowcmd.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "authority/motion.h"

namespace understudy::authority {

// A program on the robot's own computer, as `robot_state` lists it.
struct OnboardService {
  std::string name{};   // "sport_mode", "ai_sport", "vui_service"
  std::string alias{};  // what motion_switcher calls it ("normal", "ai", "mcf"); "" when it moves
                        // nothing
  bool on = true;
  bool is_protected = false;  // refuses to be switched
};

// What became of a wish to change the owner. motion_switcher and robot_state turn it into their
// codes.
enum class OwnerVerdict : std::uint8_t {
  kDone,
  kUnknownName,
  kProtected,
  kNoController,  // the robot has that service, nothing here plays it
};

// At most one motion service is on at a time; while one is, it moves the motors and rt/lowcmd is
// not followed (docs/sources.md#who-moves-the-motors). All calls come from the tick's thread
// and return at once.
class MotorOwner {
 public:
  // `services` are those on board, at most one with an alias on. `motion` plays whichever motion
  // service is on; null where none can be played: then none with an alias may be on.
  // `form` is motion_switcher's word: "0" legged, "1" wheel-legged.
  MotorOwner(std::vector<OnboardService> services, std::string form,
             std::unique_ptr<Motion> motion);

  // Alias of the motion service that is on; "" when rt/lowcmd moves the motors.
  std::string_view active() const;
  std::string_view form() const { return form_; }
  std::span<const OnboardService> services() const { return services_; }

  OwnerVerdict Select(std::string_view alias);  // kUnknownName, kNoController
  void Release();                               // nothing moves the motors but rt/lowcmd
  OwnerVerdict Switch(std::string_view service, bool on);

  // A wish of motion_switcher: do not start a motion service at boot. Only remembered.
  void SetSilent(bool on) { silent_ = on; }
  bool silent() const { return silent_; }

  // rt/user_lowcmd moves the motors as long as the service that is on leaves them to it (G1, loco
  // api 7110 to 7111). Ends with the service.
  void SetUserControl(bool on) { user_control_ = on; }
  bool user_control() const { return user_control_ && !active().empty(); }

  // Whether the sticks of the remote controller move the robot (SwitchJoystick). They do again when
  // a service starts anew (*assumed*).
  void SetSticks(bool on) { sticks_ = on; }
  bool sticks() const { return sticks_; }

  // The robot has been put back to where it started: the service that is on starts anew.
  void Restart();

  // Hands a goal to the service that is on; kNotNow when none is.
  MotionVerdict Ask(const MotionGoal& goal);
  // That of the motion service; default values when none is on.
  robot::MotionState state() const;

  // One step of the service that is on. Returns false, `command` untouched, when none is. After a
  // change of owner the service starts anew.
  bool Step(const MotionInput& input, double dt, robot::RobotCommand* command);

 private:
  std::vector<OnboardService> services_;
  std::string form_;
  std::unique_ptr<Motion> motion_;
  bool silent_ = false;
  bool user_control_ = false;
  bool sticks_ = true;
  bool fresh_ = true;  // the service has not started yet
};

}  // namespace understudy::authority
