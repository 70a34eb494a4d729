// The keys of robot.motion: how the robot's motion service stands, walks and protects it.
#include "config/keys.h"
#include "motion/protection.h"

namespace understudy::config {
namespace {

void DescribeSteps(Archive& a, robot::StepSpec& s) {
  a.Key(UNDERSTUDY_NVP(s.time),
        {"s", {0, 1}, "Time of a step; 0 is 0.32 s, longer by the root of the robot's height"});
  a.Key(UNDERSTUDY_NVP(s.foot_raise), {"m", {0, 0.3}, "How far a swinging foot is lifted"});
  a.Key(UNDERSTUDY_NVP(s.least_speed),
        {"m/s, m/s, rad/s", {-3, 0}, "Lower limits of a command: forward, left, turn"});
  a.Key(UNDERSTUDY_NVP(s.most_speed), {"m/s, m/s, rad/s", {0, 3}, "Most of these"});
}

void DescribeHumanoidMotion(Archive& a, robot::HumanoidMotionSpec& h) {
  constexpr Range kId{-1, 1000};
  a.Key(UNDERSTUDY_NVP(h.lock_stand), {"", kId, "State with joints locked, standing"});
  a.Key(UNDERSTUDY_NVP(h.balance),
        {"", kId, "States that stand balanced and walk, the usual one first"});
  a.Key(UNDERSTUDY_NVP(h.arms_balance),
        {"", kId,
         "State that it tells in place of the first of balance while rt/arm_sdk has a "
         "weight; -1 is none"});
  a.Key(UNDERSTUDY_NVP(h.squat), {"", kId, "State with joints locked in squat_q; -1 is none"});
  a.Key(UNDERSTUDY_NVP(h.sit), {"", kId, "State with joints locked in sit_q; -1 is none"});
  a.Key(
      UNDERSTUDY_NVP(h.protection),
      {"", kId, "State that it tells in place of damping while its protection damps; -1 is none"});
  a.Key(UNDERSTUDY_NVP(h.balanced_squat),
        {"", kId, "State that squats and rises again while balancing; -1 is none"});
  a.Key(UNDERSTUDY_NVP(h.walk),
        {"", kId,
         "States in which the controller policy walks; with another controller they are not "
         "simulated, unless balance has them"});
  a.Key(UNDERSTUDY_NVP(h.unplayed),
        {"", kId, "States that the real robot has and that are not simulated"});
  a.Key(UNDERSTUDY_NVP(h.squat_q), {"rad", {-10, 10}, "Joint angles of the squat in motor order"});
  a.Key(UNDERSTUDY_NVP(h.sit_q), {"rad", {-10, 10}, "Joint angles of sitting in motor order"});
  a.Key(UNDERSTUDY_NVP(h.stand_heights),
        {"Whether it follows a request for a stand height; else it answers 0 and stays as it is"});
  a.Key(UNDERSTUDY_NVP(h.arm_actions), {"Whether arms wave, shake hands and so on"});
  a.Section(UNDERSTUDY_NVP(h.steps), {"How it walks"}, DescribeSteps);
}

void DescribeWalk(Archive& a, robot::WalkSpec& w) {
  a.Key(UNDERSTUDY_NVP(w.period), {"s", {0.1, 2}, "Stride at rest and at the most speed forwards"});
  a.Key(UNDERSTUDY_NVP(w.duty),
        {"", {0.5, 0.9}, "Part of the stride that a foot stands, at rest and at the most speed"});
  a.Key(UNDERSTUDY_NVP(w.foot_raise), {"m", {0, 0.5}, "How far a swinging foot is lifted"});
  a.Key(UNDERSTUDY_NVP(w.friction), {"", {0.05, 2}, "Friction of the ground that it counts on"});
  a.Key(UNDERSTUDY_NVP(w.least_speed),
        {"m/s, m/s, rad/s", {-10, 0}, "Lower limits of a command: forward, left, turn"});
  a.Key(UNDERSTUDY_NVP(w.most_speed), {"m/s, m/s, rad/s", {0, 10}, "Most of these"});
  a.Key(UNDERSTUDY_NVP(w.dead_band),
        {"m/s, m/s, rad/s", {0, 1}, "Dead zone: a command within all of these counts as zero"});
  a.Key(UNDERSTUDY_NVP(w.gain), {"", {0, 2}, "Velocity over the command, forward, left, turn"});
  a.Key(UNDERSTUDY_NVP(w.time_constant),
        {"s", {0.01, 5}, "Time constant of its response, forward, left, turn"});
  a.Key(UNDERSTUDY_NVP(w.dead_time), {"s", {0, 0.25}, "Until it begins to"});
  a.Key(UNDERSTUDY_NVP(w.turn_scrub),
        {"", {0.5, 5}, "Speed of wheels in a turn over that of rolling without slip"});
}

void DescribeQuadrupedMotion(Archive& a, robot::QuadrupedMotionSpec& m) {
  a.Key(UNDERSTUDY_NVP(m.stand_height), {"m", {0, 2}, "Height of the base standing"});
  a.Key(UNDERSTUDY_NVP(m.foot_x), {"m", {-1, 1}, "How far ahead of the hips the feet stand"});
  a.Key(UNDERSTUDY_NVP(m.height_range),
        {"m", {-1, 1}, "Lower and upper limit of body height over stand_height"});
  a.Key(UNDERSTUDY_NVP(m.euler_range),
        {"rad", {0, 1.5}, "Largest roll, pitch and yaw of the body to either side"});
  a.Key(UNDERSTUDY_NVP(m.sit),
        {"",
         {-2, 2},
         "Base when sitting: m ahead of the balanced stand, m over stand_height, rad of pitch"});
  a.Key(UNDERSTUDY_NVP(m.stands_up),
        {"Whether a lying robot stands up by itself when its motion service starts"});
  a.Key(UNDERSTUDY_NVP(m.gestures_from_lock),
        {"Whether gestures, Sit and Pose are taken in the locked stand, out of which it balances "
         "first, and StandUp while it sits; else they are refused there"});
  a.Key(UNDERSTUDY_NVP(m.kp), {"N·m/rad", {1, 1e5}, "Gain of the legs' joints"});
  a.Key(UNDERSTUDY_NVP(m.kd), {"N·m·s/rad", kNotNegative, "Damping of the legs' joints"});
  a.Key(UNDERSTUDY_NVP(m.damping_kd),
        {"N·m·s/rad", kNotNegative, "Damping of all joints in the damping state"});
  a.Key(UNDERSTUDY_NVP(m.wheel_kp),
        {"N·m/rad", kNotNegative, "Gain that keeps wheels in place while balancing"});
  a.Key(UNDERSTUDY_NVP(m.wheel_kd), {"N·m·s/rad", kNotNegative, "Damping that brakes wheels"});
  a.Section(UNDERSTUDY_NVP(m.walk), {"How it walks"}, DescribeWalk);
}

void DescribeRule(Archive& a, robot::ProtectionRule& r) {
  a.Choice(UNDERSTUDY_NVP(r.does), {"What the service does about it"},
           {"nothing", "warn", "stop", "lie_down", "damp"});
  a.Key(UNDERSTUDY_NVP(r.limit), {"", kNotNegative, "How much of it there may be"});
  a.Key(UNDERSTUDY_NVP(r.time), {"s", {0, 60}, "For how long it has to be more"});
}

void DescribeProtection(Archive& a, robot::ProtectionSpec& p) {
  for (const motion::DangerRow& row : motion::Dangers()) {
    a.Section(Named{row.name, &(p.*row.rule)}, {row.is}, DescribeRule, "does");
  }
}

}  // namespace

void DescribeMotionService(Archive& a, robot::MotionSpec& m) {
  a.Section(UNDERSTUDY_NVP(m.protection),
            {"What the service watches for by itself, while it is on, and what it does about it"},
            DescribeProtection);
  a.Section(UNDERSTUDY_NVP(m.humanoid), {"State machine of a humanoid"}, DescribeHumanoidMotion);
  a.Section(UNDERSTUDY_NVP(m.quadruped), {"How a quadruped stands and moves"},
            DescribeQuadrupedMotion);
}

}  // namespace understudy::config
