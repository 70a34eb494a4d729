#include "motion/humanoid/walk.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "motion/rotations.h"

namespace understudy::motion {
namespace {

// All assumed, tried on every robot here with noise, delay, pushes and low friction.
constexpr double kKneesBent = 0.07;       // m lower than it stands: straight knees cannot give way
constexpr double kNarrower = 0.02;        // m, of the feet's distance, walking
constexpr double kGap = 0.06;             // m, between soles that pass each other
constexpr double kMostLeastWidth = 0.13;  // m
constexpr double kStepTime = 0.32;       // s, of a robot whose centre of mass walks as high as this
constexpr double kStepHeight = 0.62;     // m
constexpr double kTouchDeadBand = 0.01;  // m/s, rad/s: a command within is none
const Eigen::Vector3d kPull(0.6, 0.4, 1);  // m/s², rad/s², of the velocity
constexpr double kTrimShare = 0.3;         // of what two steps were too slow or too fast by
constexpr double kMostTrim = 0.15;         // m/s, slower
constexpr double kFaster = 0.03;           // m/s: where soles slip, more would make it fall
constexpr double kSteady = 0.05;           // m/s, between wanted velocities that count as one
constexpr double kHeadingSlip = 0.3;       // rad, of the base behind the heading
constexpr double kRiseSpeed = 0.15;        // m/s, of the body
constexpr double kBendSpeed = 0.3;         // m/s, of the body, downwards
constexpr double kBlind = 0.06;            // s after touchdown in which soles are trusted less
constexpr double kLeastTrust = 0.3;
// Standing and swaying.
constexpr double kStandGain = 2;       // as StepPlanner's, of both soles
constexpr double kLeastShare = 0.05;   // of the weight, on either foot
constexpr double kStandEdge = 0.8;     // of a half sole, that the stand leans on
constexpr double kTopplesAhead = 0.8;  // of a half sole, of the capture point
constexpr double kTopplesAside = 0.4;  // of the feet's distance
constexpr double kStandFirst = 0.3;    // s, before another walk begins
constexpr double kSwayRamp = 0.06;     // s
constexpr double kSwayShare = 0.9;     // of the weight, on the foot that it pushes off from
constexpr double kLongestSway = 1;     // s
constexpr double kHurriedSway = 0.2;   // s, of one that topples
constexpr double kSettled = 1;         // s, in which a stand becomes calm
// Where a walk may end.
constexpr double kStill = 0.02;      // m/s, rad/s
constexpr double kLevelFeet = 0.04;  // m
constexpr double kMiddle = 0.03;     // m
constexpr double kBetween = 0.45;    // of the feet's distance
constexpr double kWideFeet = 1.15;   // of the width
// Springs and dampers, 1/s² and 1/s.
constexpr double kHeightSpring = 150, kHeightDamper = 20, kMostHeight = 0.05;  // m
const Eigen::Vector3d kTurnSpring(400, 400, 100), kTurnDamper(30, 30, 18);
constexpr double kMostTurn2 = 80;  // rad/s²
constexpr double kFootSpring = 400, kFootDamper = 40;
constexpr double kMostFoot = 150, kMostFootTurn = 300;  // m/s², rad/s²
// Arms.
constexpr double kArmSwing = 0.6;  // rad, per m that the other foot is ahead
constexpr double kMostArm = 0.6;   // rad
constexpr double kArmRate = 20;    // rad/s

Eigen::Vector3d Clamped(const Eigen::Vector3d& x, double most) {
  return x.cwiseMin(most).cwiseMax(-most);
}

}  // namespace

HumanoidWalk::HumanoidWalk(const mjModel& model, const robot::RobotSpec& spec,
                           const JointGains& gains, BodyModel* body, ArmActionPlayer* arms)
    : spec_(spec),
      gains_(gains),
      arms_(arms),
      body_(model, spec, *body),
      solver_(body_),
      planner_({}),
      of_leg_(spec.motors.size()),
      tau_(spec.motors.size()) {
  standing_ = StandOf(spec.standing.q, body).com_height;
  walking_ = standing_ - kKneesBent;
  const std::span<const Sole> soles = body->soles();
  distance_ = (soles[0].p_OS - soles[1].p_OS).head<2>().norm();
  const robot::StepSpec& steps = spec.motion.humanoid.steps;
  StepFigures figures{
      .rate = std::sqrt(body->gravity() / walking_),
      .time = steps.time > 0 ? steps.time : kStepTime * std::sqrt(walking_ / kStepHeight),
      .width = distance_ - kNarrower,
      .half_length = std::min(soles[0].half_length, soles[1].half_length),
      .half_width = std::min(soles[0].half_width, soles[1].half_width)};
  figures.least_width = std::min(kMostLeastWidth, 2 * figures.half_width + kGap);
  planner_ = StepPlanner(figures);
  for (const WalkBody::Foot& foot : body_.feet()) {
    for (const int motor : foot.motors) of_leg_[static_cast<std::size_t>(motor)] = true;
  }
  for (const int motor : arms->motors()) {
    const auto i = static_cast<std::size_t>(motor);
    const std::string& joint = spec.motors[i].joint;
    if (joint == "left_shoulder_pitch_joint") swinging_.push_back({.motor = i, .side = 1});
    if (joint == "right_shoulder_pitch_joint") swinging_.push_back({.motor = i, .side = -1});
  }
}

void HumanoidWalk::Ask(const Eigen::Vector3d& velocity, double hold) {
  const robot::StepSpec& steps = spec_.motion.humanoid.steps;
  wish_ = velocity.cwiseMin(steps.most_speed).cwiseMax(steps.least_speed);
  if (wish_.cwiseAbs().maxCoeff() < kTouchDeadBand) wish_.setZero();
  counts_for_ = hold;
}

void HumanoidWalk::Forget() {
  wish_.setZero();
  keeps_stepping_ = false;
}

void HumanoidWalk::Begin(const HumanoidReading& sensed) {
  body_.Update(sensed.q, sensed.dq, sensed.imu);
  const Eigen::Matrix3d& R = body_.R_WB();
  heading_ = std::atan2(R(1, 0), R(0, 0));
  velocity_.setZero();
  stance_ = 0;
  estimator_.Begin(body_, stance_);
  phase_ = Phase::kStand;
  elapsed_ = kStandFirst;
  ReadPendulum();
  height_ = com_.z() - Place(stance_).z();
  trim_.setZero();
  marks_ = {};
  walked_ = 0;
  for (Arm& arm : swinging_) arm = {.motor = arm.motor, .side = arm.side};
}

bool HumanoidWalk::Topples(const HumanoidReading& sensed) const {
  const BodyModel& body = sensed.body;
  const Eigen::Vector3d toes = body.soles()[0].forward + body.soles()[1].forward;
  const Eigen::Vector2d ahead = toes.head<2>().normalized();
  const Eigen::Vector2d capture =
      (body.com() + body.com_velocity() / planner_.figures().rate).head<2>();
  const double aside = ahead.x() * capture.y() - ahead.y() * capture.x();
  return std::abs(ahead.dot(capture)) > kTopplesAhead * planner_.figures().half_length ||
         std::abs(aside) > kTopplesAside * distance_;
}

bool HumanoidWalk::Topples() const {
  const Eigen::Vector2d capture = CaptureFrom((Place(0) + Place(1)) / 2);
  return std::abs(capture.x()) > kTopplesAhead * planner_.figures().half_length ||
         std::abs(capture.y()) > kTopplesAside * distance_;
}

bool HumanoidWalk::over() const {
  return phase_ == Phase::kStand && elapsed_ > kSettled && !wanted() && height_ == standing_;
}

Eigen::Matrix3d HumanoidWalk::Heading() const {
  return Eigen::AngleAxisd(heading_, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

Eigen::Vector2d HumanoidWalk::InHeading(const Eigen::Vector3d& way) const {
  return (Heading().transpose() * way).head<2>();
}

Eigen::Vector2d HumanoidWalk::CaptureFrom(const Eigen::Vector3d& place) const {
  return InHeading(Eigen::Vector3d(capture_.x(), capture_.y(), 0) - place);
}

void HumanoidWalk::Step(const HumanoidReading& sensed, double dt, robot::RobotCommand* command) {
  counts_for_ -= dt;
  if (counts_for_ <= 0) wish_.setZero();
  elapsed_ += dt;
  walked_ += dt;
  Sense(sensed, dt);
  Slew(dt);
  ReadPendulum();
  ChangePhase();
  task_ = {.stance = stance_, .velocity = estimator_.velocity()};
  if (phase_ == Phase::kStep) Plan();
  ShareLoad();
  MoveFoot(dt);
  MoveBody(dt);
  arms_->Advance(dt);
  SwingArms(dt);
  solver_.Solve(task_, sensed.q, sensed.dq, tau_);
  Write(sensed, command);
}

void HumanoidWalk::Sense(const HumanoidReading& sensed, double dt) {
  const robot::ImuReading imu = estimator_.Corrected(sensed.imu);
  body_.Update(sensed.q, sensed.dq, imu);
  std::array<double, 2> resting = {0.5, 0.5};
  double trust = 1;
  if (phase_ == Phase::kStep) {
    const double old = std::max(0.0, 1 - elapsed_ / kSharedTime);
    resting[other()] = old;
    resting[stance_] = 1 - old;
    trust = std::clamp(elapsed_ / kBlind, kLeastTrust, 1.0);
  }
  estimator_.Step(body_, imu, resting, trust, dt);
}

void HumanoidWalk::ReadPendulum() {
  com_ = estimator_.base() + body_.com();
  com_velocity_ = estimator_.velocity() + body_.com_velocity();
  // The velocity that a point mass with the same angular momentum about the stance sole would have.
  const double mass = body_.mass();
  const Eigen::Vector3d sole = Place(stance_);
  const Eigen::Vector3d about_base =
      body_.momentum() + mass * body_.com().cross(estimator_.velocity());
  const Eigen::Vector3d momentum =
      about_base + (estimator_.base() - sole).cross(mass * com_velocity_);
  const Eigen::Vector2d velocity =
      Eigen::Vector2d(momentum.y(), -momentum.x()) / (mass * (com_.z() - sole.z()));
  capture_ = com_.head<2>() + velocity / planner_.figures().rate;
}

void HumanoidWalk::Slew(double dt) {
  const Eigen::Vector3d wanted = phase_ == Phase::kStep ? wish_ : Eigen::Vector3d::Zero();
  const Eigen::Vector3d most = kPull * dt;
  velocity_ += (wanted - velocity_).cwiseMin(most).cwiseMax(-most);
  const double yaw = std::atan2(body_.R_WB()(1, 0), body_.R_WB()(0, 0));
  const double ahead = std::remainder(heading_ + velocity_.z() * dt - yaw, 2 * M_PI);
  heading_ = yaw + std::clamp(ahead, -kHeadingSlip, kHeadingSlip);
}

void HumanoidWalk::ChangePhase() {
  switch (phase_) {
    case Phase::kStand:
      if (elapsed_ < kStandFirst) break;
      if (Topples()) {
        const double aside = CaptureFrom((Place(0) + Place(1)) / 2).y();
        StandOn(aside * side() < 0 ? other() : stance_);
        if (std::abs(aside) > kTopplesAside * distance_) {
          LiftOff(kSharedTime);
        } else {
          BeginSway(/*topples=*/true);
        }
      } else if (wanted()) {
        // The foot on the side to which it goes steps first.
        const double to = wish_.y() != 0 ? wish_.y() : wish_.z();
        StandOn(to * side() > 0 ? other() : stance_);
        BeginSway(/*topples=*/false);
      }
      break;
    case Phase::kSway:
      if (MayLiftOff()) {
        LiftOff(kSharedTime);
      } else if (elapsed_ > kLongestSway) {
        phase_ = Phase::kStand;
        elapsed_ = 0;
      }
      break;
    case Phase::kStep:
      if (elapsed_ >= plan_.time) TouchDown();
  }
}

void HumanoidWalk::BeginSway(bool topples) {
  phase_ = Phase::kSway;
  elapsed_ = 0;
  topples_ = topples;
}

bool HumanoidWalk::MayLiftOff() const {
  const double aside = CaptureFrom(Place(stance_)).y();
  if (topples_) return planner_.FitsAside(side(), aside) || elapsed_ > kHurriedSway;
  return side() * aside > side() * planner_.Orbit(side(), {0, 0, 0}).y();
}

void HumanoidWalk::StandOn(std::size_t foot) {
  if (foot == stance_) return;
  stance_ = foot;
  estimator_.Plant(body_, foot);
  ReadPendulum();
}

void HumanoidWalk::LiftOff(double elapsed) {
  phase_ = Phase::kStep;
  elapsed_ = elapsed;
  planner_.Begin();
}

void HumanoidWalk::TouchDown() {
  const double late = elapsed_ - plan_.time;
  Trim();
  StandOn(other());
  LiftOff(late);
  if (!MayStand()) return;
  phase_ = Phase::kStand;
  elapsed_ = 0;
}

void HumanoidWalk::Trim() {
  const Mark now{.com = com_, .velocity = velocity_, .time = walked_};
  const Mark before = std::exchange(marks_[1], std::exchange(marks_[0], now));
  if (before.time <= 0 || (now.velocity - before.velocity).norm() > kSteady) return;
  const double time = now.time - before.time;
  // Two steps ago its heading was that much behind; in the mean half of it.
  const Eigen::AngleAxisd back(velocity_.z() * time / 2, Eigen::Vector3d::UnitZ());
  const Eigen::Vector2d mean = InHeading(back * (now.com - before.com)) / time;
  for (int i = 0; i < 2; ++i) {
    const double low = velocity_[i] < 0 ? -kFaster : -kMostTrim;
    const double high = velocity_[i] > 0 ? kFaster : kMostTrim;
    trim_[i] = std::clamp(trim_[i] + kTrimShare * (velocity_[i] - mean[i]), low, high);
  }
}

bool HumanoidWalk::MayStand() const {
  if (wanted() || velocity_.cwiseAbs().maxCoeff() > kStill) return false;
  const Eigen::Vector2d feet = InHeading(Place(0) - Place(1)) * body_.feet()[0].side;
  const Eigen::Vector2d capture = CaptureFrom((Place(0) + Place(1)) / 2);
  return std::abs(feet.x()) < kLevelFeet && feet.y() < kWideFeet * planner_.figures().width &&
         std::abs(capture.x()) < kMiddle && std::abs(capture.y()) < kBetween * feet.y();
}

void HumanoidWalk::Plan() {
  const double yaw = std::remainder(body_.feet()[stance_].yaw() - heading_, 2 * M_PI);
  plan_ = planner_.Step(elapsed_, side(), CaptureFrom(Place(stance_)), velocity_ + trim_, yaw);
  task_.pressure = Heading() * Eigen::Vector3d(plan_.pressure.x(), plan_.pressure.y(), 0);
}

void HumanoidWalk::ShareLoad() {
  const Eigen::Vector3d here = Place(stance_), there = Place(other());
  shared_ = 0;
  if (phase_ == Phase::kStep) {
    shared_ = std::max(0.0, 1 - elapsed_ / kSharedTime);
  } else {
    const Eigen::Vector2d pressure = kStandGain * CaptureFrom((here + there) / 2);
    const double edge = kStandEdge * planner_.figures().half_length;
    const double apart = InHeading(there - here).y();
    shared_ = phase_ == Phase::kSway
                  ? std::min(0.5 + 0.5 * elapsed_ / kSwayRamp, kSwayShare)
                  : std::clamp(0.5 + pressure.y() / apart, kLeastShare, 1 - kLeastShare);
    task_.pressure = Heading() * Eigen::Vector3d(std::clamp(pressure.x(), -edge, edge), 0, 0);
    task_.other_at = task_.pressure;
  }
  // The foot that carries more holds the trunk: the other would slip.
  const bool other_holds = shared_ > 0.5;
  if (other_holds) {
    task_.stance = other();
    std::swap(task_.pressure, task_.other_at);
  }
  const double weight = (other_holds ? 1 - shared_ : shared_) * body_.mass() * body_.gravity();
  const Eigen::Vector3d way = com_ - (other_holds ? here : there) - task_.other_at;
  task_.other_force = weight / (com_.z() - here.z()) * way;
  task_.other_force.z() = weight;
}

void HumanoidWalk::MoveFoot(double dt) {
  const WalkBody::Foot& foot = body_.feet()[1 - task_.stance];
  const Eigen::Vector3d v = estimator_.velocity() + foot.v;
  const double aloft = elapsed_ - kSharedTime;
  if (phase_ != Phase::kStep || aloft <= 0) {
    swing_.Begin(Place(other()), body_.feet()[other()].yaw());
    task_.foot_a = Clamped(-kFootDamper * v, kMostFoot);
    task_.foot_turn = Clamped(-kFootDamper * foot.w, kMostFootTurn);
    return;
  }
  const Eigen::Vector3d landing =
      Place(stance_) + Heading() * Eigen::Vector3d(plan_.landing.x(), plan_.landing.y(), 0);
  swing_.Step(aloft, plan_.time - kSharedTime, landing, heading_ + plan_.turn,
              spec_.motion.humanoid.steps.foot_raise, dt);
  task_.foot_a = Clamped(
      swing_.a() + kFootSpring * (swing_.p() - Place(other())) + kFootDamper * (swing_.v() - v),
      kMostFoot);
  const Eigen::Matrix3d level =
      Eigen::AngleAxisd(swing_.yaw(), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  task_.foot_turn =
      Clamped(kFootSpring * RotationVector(level * foot.R.transpose()) - kFootDamper * foot.w,
              kMostFootTurn);
}

void HumanoidWalk::MoveBody(double dt) {
  const bool rises = phase_ == Phase::kStand && !wanted();
  height_ +=
      std::clamp((rises ? standing_ : walking_) - height_, -kBendSpeed * dt, kRiseSpeed * dt);
  const double low = height_ - (com_.z() - Place(stance_).z());
  task_.lift = kHeightSpring * std::clamp(low, -kMostHeight, kMostHeight) -
               kHeightDamper * com_velocity_.z();
  const Eigen::Vector3d off = RotationVector(Heading() * body_.R_WB().transpose());
  const Eigen::Vector3d rate(0, 0, velocity_.z());
  task_.turn = Clamped(
      kTurnSpring.cwiseProduct(off) + kTurnDamper.cwiseProduct(rate - body_.w_WB_W()), kMostTurn2);
}

void HumanoidWalk::SwingArms(double dt) {
  const Eigen::Vector3d apart = (Place(0) - Place(1)) * body_.feet()[0].side;
  const double ahead = InHeading(apart).x();  // of the left foot
  const bool swings = phase_ == Phase::kStep && arms_->id() == 0;
  for (Arm& arm : swinging_) {
    const double wanted =
        swings ? arm.side * std::clamp(kArmSwing * ahead, -kMostArm, kMostArm) : 0;
    arm.ddq = kArmRate * kArmRate * (wanted - arm.q) - 2 * kArmRate * arm.dq;
    arm.dq += arm.ddq * dt;
    arm.q += arm.dq * dt;
    solver_.known()[arm.motor] = arm.ddq;
  }
}

void HumanoidWalk::Write(const HumanoidReading& sensed, robot::RobotCommand* command) const {
  for (std::size_t i = 0; i < tau_.size(); ++i) {
    robot::MotorCommand& motor = command->motors[i];
    const double most = spec_.motors[i].torque_limit;
    const double friction = of_leg_[i] ? body_.Friction(i, sensed.dq[i]) : 0;
    motor = {.enabled = true,
             .q = of_leg_[i] ? sensed.q[i] : spec_.standing.q[i],
             .tau = std::clamp(tau_[i] + friction, -most, most)};
    if (of_leg_[i]) continue;
    motor.kp = gains_.kp[i];
    motor.kd = gains_.kd[i];
  }
  for (std::size_t i = 0; i < arms_->motors().size(); ++i) {
    robot::MotorCommand& motor = command->motors[static_cast<std::size_t>(arms_->motors()[i])];
    motor.q = arms_->q(i);
    motor.dq = arms_->dq(i);
  }
  for (const Arm& arm : swinging_) {
    command->motors[arm.motor].q += arm.q;
    command->motors[arm.motor].dq += arm.dq;
  }
}

}  // namespace understudy::motion
