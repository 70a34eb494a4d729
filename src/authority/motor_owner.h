// Decides who moves the motors: a motion service or the programs that write rt/lowcmd.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "authority/motion.h"

namespace understudy::authority {

// A program on the robot's computer, as `robot_state` lists it.
struct OnboardService {
  std::string name{};   // "sport_mode", "ai_sport", "vui_service"
  std::string alias{};  // what motion_switcher calls it ("normal", "ai", "mcf"); "" when it moves
                        // nothing
  bool on = true;
  bool is_protected = false;  // cannot be switched on or off
  std::string version{};      // "" if it is not told
};

// What robot_state was asked to tell of the programs by itself.
struct ProgramReport {
  int interval = 0;         // s; 0: nothing
  int duration = 0;         // s; 0: for good
  std::uint64_t asked = 0;  // how often it was asked for
};

// The result of a request to change the owner; motion_switcher and robot_state have codes for it.
enum class OwnerVerdict : std::uint8_t {
  kDone,
  kUnknownName,
  kProtected,
  kNoController,  // not simulated, though the robot has the service
};

// At most one motion service is on at a time; it moves the motors and rt/lowcmd is not followed
// (docs/sources.md#who-moves-the-motors). For the tick's thread.
class MotorOwner {
 public:
  // `services` are the programs of the robot, of which at most one with an alias is on. `motion` is
  // the controller of all motion services; null if none is simulated, and then none may be on.
  // `form` is that of motion_switcher: "0" legged, "1" wheel-legged.
  MotorOwner(std::vector<OnboardService> services, std::string form,
             std::unique_ptr<Motion> motion);

  // Returns the alias of the motion service that is on; "" if rt/lowcmd moves the motors.
  std::string_view active() const;
  std::string_view form() const { return form_; }
  std::span<const OnboardService> services() const { return services_; }

  OwnerVerdict Select(std::string_view alias);  // kUnknownName, kNoController
  void Release();                               // switches the motion service off
  OwnerVerdict Switch(std::string_view service, bool on);

  // Sets motion_switcher's setting not to start a motion service at boot.
  void SetSilent(bool on) { silent_ = on; }
  bool silent() const { return silent_; }

  // Lets rt/user_lowcmd move the motors while the service is on (G1, loco api 7110 and 7111). Ends
  // with the service.
  void SetUserControl(bool on) { user_control_ = on; }
  bool user_control() const { return user_control_ && !active().empty(); }

  // Sets whether the sticks of the remote controller move the robot (SwitchJoystick). A restart of
  // the service sets it again (*assumed*).
  void SetSticks(bool on) { sticks_ = on; }
  bool sticks() const { return sticks_; }

  // Asks for reports of the programs, in place of any asked for before.
  void AskReport(int interval, int duration) {
    report_ = {.interval = interval, .duration = duration, .asked = report_.asked + 1};
  }
  const ProgramReport& report() const { return report_; }

  // Restarts the service that is on, after the robot was put back in a start pose.
  void Restart();

  // Gives a goal to the service that is on; kNotNow if none is.
  MotionVerdict Ask(const MotionGoal& goal);
  // Returns the worst verdict that Ask has returned since the last call, kTaken if none: for those
  // who ask in the name of somebody whom they do not tell it.
  MotionVerdict TakeVerdict() { return std::exchange(worst_, MotionVerdict::kTaken); }
  // Returns the state of the motion service; default values if none is on.
  const robot::MotionState& state() const { return state_; }

  // Makes one step of the service that is on; after a change of owner the service first starts. If
  // none is on, returns false and leaves `command`.
  bool Step(const MotionInput& input, double dt, robot::RobotCommand* command);

 private:
  void NoteState();

  std::vector<OnboardService> services_;
  std::string form_;
  std::unique_ptr<Motion> motion_;
  ProgramReport report_;
  bool silent_ = false;
  bool user_control_ = false;
  bool sticks_ = true;
  bool fresh_ = true;  // the service has not started yet
  MotionVerdict worst_ = MotionVerdict::kTaken;
  robot::MotionState state_;  // as of the last call that may change it
};

}  // namespace understudy::authority
