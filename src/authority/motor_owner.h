// Decides who moves the motors: a motion service or the programs that write rt/lowcmd.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "authority/motion.h"
#include "authority/onboard_state.h"

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

// The program of a Go2's lidar, which rt/utlidar/switch switches.
inline constexpr std::string_view kLidarProgram = "unitree_lidar";
inline constexpr std::string_view kAvoidProgram = "obstacles_avoidance";
inline constexpr std::string_view kLivoxProgram = "lidar_driver";  // of a G1's

// The result of a request to change the owner; motion_switcher and robot_state have codes for it.
enum class OwnerVerdict : std::uint8_t {
  kDone,
  kUnknownName,
  kProtected,
  kNoController,  // not simulated, though the robot has the service
};

// Makes the controller of the motion service with that alias; null if none is simulated.
using MotionMaker = std::function<std::unique_ptr<Motion>(std::string_view alias)>;

// At most one motion service is on at a time; it moves the motors and rt/lowcmd is not followed
// (docs/dev/sources.md#who-moves-the-motors). For the tick's thread.
class MotorOwner {
 public:
  // `services` are the programs of the robot, of which at most one with an alias is on. Calls
  // `make` once for each alias; null makes no controllers. A service without a controller must be
  // off. `form` is that of motion_switcher: "0" legged, "1" wheel-legged.
  MotorOwner(std::vector<OnboardService> services, std::string form, const MotionMaker& make);

  // Returns the alias of the motion service that is on; "" if rt/lowcmd moves the motors.
  std::string_view active() const;
  std::string_view form() const { return form_; }
  std::span<const OnboardService> services() const { return services_; }

  OwnerVerdict Select(std::string_view alias);  // kUnknownName, kNoController
  void Release();                               // switches the motion service off
  OwnerVerdict Switch(std::string_view service, bool on);

  OnboardState& onboard() { return onboard_; }
  const OnboardState& onboard() const { return onboard_; }
  // Whether the service that is on lets rt/user_lowcmd move the motors.
  bool user_control() const { return onboard_.user_control && !active().empty(); }

  // Whether a program runs. One that the robot does not list always does.
  bool Runs(std::string_view program) const;
  // Whether the sticks and obstacles_avoid move it round obstacles.
  bool avoids() const { return onboard_.avoids && Runs(kAvoidProgram); }

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
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  Motion* motion() const { return active_ == kNone ? nullptr : motions_[active_].get(); }
  void NoteState();

  std::vector<OnboardService> services_;
  std::string form_;
  std::vector<std::unique_ptr<Motion>> motions_;  // by service; null: it has no controller
  std::size_t active_ = kNone;                    // index of the motion service that is on
  OnboardState onboard_;
  bool fresh_ = true;  // the service has not started yet
  MotionVerdict worst_ = MotionVerdict::kTaken;
  robot::MotionState state_;  // as of the last call that may change it
};

}  // namespace understudy::authority
