// The robot: everything that happens to it in a tick happens in Tick(), in one direction, as plain
// values.
#ifndef UNDERSTUDY_EMULATOR_EMULATOR_H_
#define UNDERSTUDY_EMULATOR_EMULATOR_H_

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "authority/command_delay.h"
#include "authority/command_router.h"
#include "config/config.h"
#include "emulator/frame.h"
#include "emulator/hand.h"
#include "emulator/inbox.h"
#include "emulator/refusal_log.h"
#include "emulator/remote.h"
#include "emulator/status.h"
#include "physics/crane.h"
#include "physics/forces.h"
#include "physics/world.h"
#include "robot/battery.h"
#include "robot/motor.h"
#include "sensors/sensors.h"
#include "time/pace.h"
#include "wire/robot_port.h"

namespace understudy::emulator {

// Owns every part of one robot but the port and the inbox. Knows no wall clock: who calls Tick
// decides the pace. The integer step count is the master of time. Two emulators with equal config
// that get equal commands at equal steps send equal states, bit for bit.
class Emulator {
 public:
  // `config` has been validated, `world` was made for config.robot; `port` and `inbox` must outlive
  // the emulator.
  Emulator(const config::Config& config, physics::PhysicsWorld world, wire::RobotPort* port,
           Inbox* inbox);
  Emulator(const Emulator&) = delete;
  Emulator& operator=(const Emulator&) = delete;

  // Events in order of time, each given to the tick of its time as if it had come by the inbox.
  // Before the first Tick. Throws ConfigError for a body that the model does not have.
  void Play(std::vector<ScriptEvent> script);

  // One physics step. After the first few it allocates nothing. On kDiverged nothing was sent for
  // this step and, with on_divergence = reset, the robot is back at its start pose while time goes
  // on.
  physics::StepHealth Tick();

  // Carries out the orders that wait, but none of the script: between ticks, so that people are
  // answered however far away the next one is.
  void TakeOrders();

  // How orders have it that Tick be called. Keeping to it is up to who calls it.
  const time::Pace& pace() const { return pace_; }

  // Stops or resumes sending; the robot goes on moving.
  void Silence(bool on) { silenced_ = on; }

  // Who moves the motors. For services, between ticks.
  authority::MotorOwner& owner() { return router_.owner(); }

  std::int64_t step() const { return step_; }
  double time() const { return static_cast<double>(step_ * step_ns_) * 1e-9; }  // s
  // Everything of Status but what only the run loop knows: ready and its punctuality.
  Status status() const;

  // What the robot is, for whoever looks on; valid as long as the emulator, changed by its calls.
  const physics::PhysicsWorld& world() const { return world_; }
  // At the joints in the last step, in motor order [N·m].
  std::span<const double> torque() const { return motors_.torque(); }
  const robot::RobotCommand& command() const { return *command_; }  // that the motors followed last
  std::span<const physics::AppliedForce> pushes() const {
    return pushes_.forces();
  }  // of the last step
  std::span<const physics::AppliedForce> drags() const { return drags_.forces(); }

  // A frame with room for all that Show fills in.
  Frame MakeFrame() const;
  // Fills in those parts that frame->parts names, of the last tick, but for the bytes of
  // wireless_remote. Between ticks; allocates nothing.
  void Show(Frame* frame) const;

 private:
  struct Start {
    robot::RobotCommand command;
    robot::PoseSpec pose;
    bool on_crane = false;
    bool clamped = false;
  };

  static constexpr std::int64_t kNever = -2;  // before any step's sample

  static std::vector<Start> StartsOf(const config::Config& config);
  std::int64_t Every(double hz) const;
  const Start& start() const { return starts_[static_cast<std::size_t>(start_pose_)]; }
  void To(const Start& start);
  wire::Due DueNow() const;
  void FollowScript(double t);
  void TakeCommands(double t);
  void TakeHandCommands(double t);
  const robot::RobotCommand& Decide(double t);
  void MoveHands(double t);
  void PushAndPull(double t);
  void Sample(std::int64_t step);  // of the instant that the world shows
  void HangFromCrane();
  Answer CarryOut(const Order& order);
  Answer BeginPush(const PushBody& push);
  Answer Drag(const DragBody& drag);
  Answer EndDrag(const ReleaseDrag& release);
  Answer MakeSteps(const StepRun& step);

  config::Config config_;
  robot::StartPose start_pose_;
  std::vector<Start> starts_;  // by StartPose
  physics::PhysicsWorld world_;
  wire::RobotPort* port_;
  Inbox* inbox_;
  authority::CommandDelay delay_;
  robot::MotorBank motors_;
  robot::Battery battery_;
  sensors::Sensors sensors_;
  physics::Crane crane_;
  Remote remote_;
  authority::CommandRouter router_;
  std::vector<Hand> hands_;
  int crane_body_;
  Eigen::Vector3d crane_point_;
  std::int64_t step_ns_;
  std::int64_t lowstate_every_, motion_every_, hand_every_, lf_every_, service_every_;  // in steps

  std::int64_t step_ = 0;
  std::vector<ScriptEvent> script_;
  std::size_t script_next_ = 0;
  std::size_t script_refused_ = 0;
  std::string script_refusal_;
  time::Pace pace_;
  physics::Pushes pushes_;
  physics::Drags drags_;
  const robot::RobotCommand* command_;
  robot::RobotCommand offered_;
  robot::HandCommand offered_hand_;
  authority::MotionInput input_;
  robot::RobotState state_;
  std::int64_t sampled_ = kNever;  // the step that state_ is of
  bool silenced_ = false;
  robot::Refusal last_refusal_ = robot::Refusal::kNone;
  RefusalLog refusals_;
  OrderNotes orders_;
  std::uint64_t published_ = 0;
  std::uint64_t divergences_ = 0;
};

}  // namespace understudy::emulator

#endif  // UNDERSTUDY_EMULATOR_EMULATOR_H_
