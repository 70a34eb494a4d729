#include "motion/humanoid/motion.h"

#include <algorithm>
#include <cmath>

#include "base/overloaded.h"

namespace understudy::motion {
namespace {

constexpr double kMoveTime = 4;  // s: on hardware within 5 s (docs/sources.md#g1-states)
// From the request to squat balanced to damping, a G1's (docs/sources.md#g1-states).
constexpr double kSquatLasts = 9;  // s

// Assumed, tried on every robot here.
constexpr double kSettleTime = 1;    // s, into the standing pose of a robot found standing
constexpr double kFoundTilt = 0.3;   // rad, at most, of a robot that stands
constexpr double kFoundPose = 0.25;  // rad, at most, off its standing pose
constexpr double kNoLoad = 0.1;      // of its weight: feet with less carry nothing

}  // namespace

HumanoidMotion::HumanoidMotion(const robot::RobotSpec& spec, const physics::RobotBody& body)
    : spec_(spec),
      ids_(spec.motion.humanoid),
      senses_(body.nominal(), body.spec()),
      gains_(FindGains(spec, senses_.body())),
      bearing_(spec.motors.size()),
      slack_(gains_, &bearing_),
      posture_(gains_, &bearing_),
      stand_(spec, gains_, senses_.body(), &bearing_) {}

void HumanoidMotion::Start(const authority::MotionInput& input) {
  senses_.Begin(input);
  Slacken(kZeroTorqueId);
  const bool can_lock = StanceOf(ids_, ids_.lock_stand) == HumanoidStance::kLockStand;
  if (can_lock && IsInStandingPose()) Lock(ids_.lock_stand, spec_.standing.q, kSettleTime);
}

bool HumanoidMotion::IsInStandingPose() const {
  const HumanoidReading& sensed = senses_.reading();
  double off = 0;
  for (std::size_t i = 0; i < sensed.q.size(); ++i) {
    if (gains_.bears[i]) off = std::max(off, std::abs(sensed.q[i] - spec_.standing.q[i]));
  }
  return off <= kFoundPose && sensed.body.attitude()(2, 2) > std::cos(kFoundTilt);
}

authority::MotionVerdict HumanoidMotion::Ask(const authority::MotionGoal& goal) {
  using authority::MotionVerdict;
  namespace goal_of = authority::goal;
  const auto when_balanced = [this](MotionVerdict verdict) {
    return balanced() ? verdict : MotionVerdict::kNotNow;
  };
  return std::visit(
      Overloaded{
          [&](goal_of::ZeroTorque) { return SetFsm(kZeroTorqueId); },
          [&](goal_of::Damp) { return SetFsm(kDampingId); },
          [&](goal_of::Fall) {
            if (!balanced()) return MotionVerdict::kNotNow;
            Slacken(kDampingId);
            return MotionVerdict::kTaken;
          },
          [&](goal_of::StandUp) { return SetFsm(ids_.lock_stand); },
          [&](goal_of::RiseSit) { return SetFsm(ids_.lock_stand); },
          [&](goal_of::StandDown) { return SetFsm(ids_.squat); },
          [&](goal_of::Sit) { return SetFsm(ids_.sit); },
          [&](goal_of::BalanceStand) {
            return SetFsm(ids_.balance.empty() ? -1 : static_cast<int>(ids_.balance.front()));
          },
          [&](const goal_of::SetFsm& fsm) { return SetFsm(fsm.id); },
          [&](goal_of::StopMove) { return when_balanced(MotionVerdict::kTaken); },  // it stands
          [&](const goal_of::Move&) { return when_balanced(MotionVerdict::kUnable); },
          [&](const goal_of::SetBalanceMode& balance) {
            return when_balanced(balance.mode == 0 ? MotionVerdict::kTaken
                                                   : MotionVerdict::kUnable);
          },
          [&](const goal_of::SetStandHeight& stand) { return SetStandHeight(stand.height); },
          [&](const goal_of::ArmAction& action) { return BeginArmAction(action.id); },
          [&](goal_of::StopArmAction) {
            stand_.arms().Release();
            return MotionVerdict::kTaken;
          },
          [&](goal_of::RecoveryStand) { return MotionVerdict::kUnable; },
          [&](const auto&) { return MotionVerdict::kUnknown; },  // a quadruped's
      },
      goal);
}

authority::MotionVerdict HumanoidMotion::SetFsm(int id) {
  const authority::MotionVerdict verdict = MayGo(ids_, id_, id, moving());
  if (verdict != authority::MotionVerdict::kTaken) return verdict;
  if (id == id_ && id != ids_.balanced_squat) return verdict;
  // States that bear load.
  if (id == kZeroTorqueId && id_ != kDampingId) return authority::MotionVerdict::kIgnored;
  if (id == kZeroTorqueId || id == kDampingId) {
    Slacken(id);
  } else if (id == ids_.lock_stand) {
    Lock(id, spec_.standing.q, kMoveTime);
  } else if (id == ids_.squat || id == ids_.sit) {
    Lock(id, id == ids_.squat ? ids_.squat_q : ids_.sit_q, kMoveTime);
  } else {
    Balance(id);
  }
  return verdict;
}

void HumanoidMotion::Slacken(int id) {
  stand_.arms().Reset();
  slack_.Begin(/*limp=*/id == kZeroTorqueId);
  now_ = &slack_;
  id_ = id;
}

void HumanoidMotion::Lock(int id, std::span<const double> q, double duration) {
  stand_.arms().Reset();
  posture_.Begin(senses_.reading(), q, duration);
  now_ = &posture_;
  id_ = id;
}

void HumanoidMotion::Balance(int id) {
  if (id == ids_.balanced_squat) {
    stand_.Squat(/*down=*/id_ != id);
    down_for_ = 0;
  } else {
    if (!balanced()) stand_.Begin(senses_.reading());
    stood_in_ = id;
  }
  now_ = &stand_;
  id_ = id;
}

authority::MotionVerdict HumanoidMotion::SetStandHeight(double height) {
  if (!std::isfinite(height)) return authority::MotionVerdict::kUnknown;
  if (!balanced()) return authority::MotionVerdict::kNotNow;
  if (ids_.squat_q.empty()) return authority::MotionVerdict::kUnable;
  if (moving() || id_ == ids_.balanced_squat) return authority::MotionVerdict::kNotNow;
  if (!ids_.stand_heights) return authority::MotionVerdict::kIgnored;
  stand_.StandAt(height);
  return authority::MotionVerdict::kTaken;
}

authority::MotionVerdict HumanoidMotion::BeginArmAction(int id) {
  if (!ids_.arm_actions) return authority::MotionVerdict::kUnknown;
  const bool allowed = balanced() && id_ != ids_.balanced_squat;
  // An unknown id is reported before a state that does not allow it.
  if (!allowed && id != kReleaseArms && FindArmAction(id) == nullptr && !IsUnplayedArmAction(id)) {
    return authority::MotionVerdict::kUnknown;
  }
  return allowed ? stand_.arms().Begin(id) : authority::MotionVerdict::kNotNow;
}

robot::MotionState HumanoidMotion::state() const {
  const ArmActionPlayer& arms = stand_.arms();
  return {.id = id_,
          .name = Name(StanceOf(ids_, id_)),
          .mode = moving() || id_ == ids_.balanced_squat ? 1
                  : unloaded()                           ? 2
                                                         : 0,
          .progress = moving() || (arms.id() != 0 && !arms.holding()) ? 1 : 0,
          .arm_action = arms.id(),
          .arm_told = arms.told(),
          .arm_holding = arms.holding(),
          .body_height = senses_.reading().body.base().z()};
}

void HumanoidMotion::Step(const authority::MotionInput& input, double dt,
                          robot::RobotCommand* command) {
  senses_.Step(input, dt);
  const HumanoidReading& sensed = senses_.reading();
  command->joint_space = robot::JointSpace::kPitchRoll;
  now_->Step(sensed, dt, command);
  if (id_ == ids_.balanced_squat) {
    down_for_ += dt;
    if (stand_.upright()) {
      id_ = stood_in_;
    } else if (stand_.squats() && down_for_ >= kSquatLasts) {
      Slacken(kDampingId);
    }
  }
  // rt/arm_sdk has a state of its own where the robot has one.
  if (ids_.arms_balance >= 0 && !ids_.balance.empty()) {
    const int usual = ids_.balance.front();
    if (id_ == usual && input.arm_weight > 0) id_ = ids_.arms_balance;
    if (id_ == ids_.arms_balance && input.arm_weight <= 0) id_ = usual;
  }
}

bool HumanoidMotion::unloaded() const {
  return kBearingStances.Has(StanceOf(ids_, id_)) && senses_.reading().load < kNoLoad;
}

std::unique_ptr<authority::Motion> MakeHumanoidMotion(const robot::RobotSpec& spec,
                                                      const physics::RobotBody& body) {
  return std::make_unique<HumanoidMotion>(spec, body);
}

}  // namespace understudy::motion
