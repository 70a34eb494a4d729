#include "motion/quadruped/trot.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "motion/quadruped/capture.h"
#include "motion/quadruped/force_qp.h"
#include "motion/quadruped/swing.h"
#include "motion/rotations.h"

namespace understudy::motion {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// All assumed, found by trying in simulation unless it says otherwise. Rates count in those of the
// pendulum, so that robots of any size move alike.
constexpr double kWait = 0.1;         // s that all feet stand before the first lifts
constexpr double kIdle = 0.6;         // s it steps on the spot before it stands
constexpr double kIdleHurried = 0.2;  // s, the same before it goes on on wheels
constexpr double kIdleSpeed = 0.1;    // m/s, most to stand from
constexpr double kAhead = 0.1;        // m, most that the wanted way is ahead of the body (MIT)
constexpr double kYawAhead = 0.2;     // rad, most that the wanted heading is ahead
constexpr double kRise = 0.2;         // m/s, of a change of height
constexpr double kFelt = 0.06;        // of the weight: a foot feels the ground
constexpr double kMayLand = 0.6;      // part of a swing from when on that ends it
constexpr double kMayLift = 0.5;      // and until when one may begin that is late
constexpr double kTrustTime = 0.03;   // s after touchdown and before lifting that a foot is doubted
constexpr double kRampTime = 0.03;    // s in which it takes the load over and gives it up
constexpr double kLeastLoad = 0.05;   // of its most, as it touches down
constexpr double kMostForce = 1.2;    // of the weight, a foot
constexpr double kLeastForce = 0.03;  // of the weight, a foot
constexpr double kPlaceGain = 0.5, kSpeedGain = 1.6;  // level gains
constexpr double kHeight = 4, kLiftSpeed = 3;         // vertical gains
constexpr double kTilt = 14, kTiltRateGain = 7;       // of roll and pitch
constexpr double kYaw = 3, kYawRate = 3;
constexpr double kMostPushed = 4, kMostLifted = 5;  // m/s²
constexpr double kMostTurn = 200;                   // rad/s²
constexpr double kReach = 0.7;     // of the leg's length, most a foothold is off its rest
constexpr double kBehind = 0.5;    // m a foothold is moved back per m that the body lags
constexpr double kSink = 0.005;    // m a foot aims under the ground
constexpr double kBrake = 0.0375;  // s, kd over kp that the joints of standing feet brake with
constexpr double kFriction = 0.9;  // part of the joints' friction that is given ahead
constexpr double kMostRate = 20;   // rad/s
constexpr double kMostRateChange = 500;  // rad/s²

Vector3d Level(const Vector3d& v) { return {v.x(), v.y(), 0}; }

// `v` no longer than `most`.
Vector3d NoLonger(const Vector3d& v, double most) {
  const double length = v.norm();
  return length > most ? Vector3d(most / length * v) : v;
}

Vector3d Within(const Vector3d& v, double most) { return v.cwiseMax(-most).cwiseMin(most); }

// Joint rates [rad/s] that move a point of a leg with v [m/s]; near a straight leg slower ones.
Vector3d JointRates(const Matrix3d& jacobian, const Vector3d& v) {
  constexpr double kDamping = 1e-4;  // m²
  const Matrix3d square = jacobian.transpose() * jacobian + kDamping * Matrix3d::Identity();
  return square.ldlt().solve(jacobian.transpose() * v);
}

}  // namespace

Trot::Trot(const QuadrupedBody& body, const QuadrupedEstimator& estimator,
           const robot::QuadrupedMotionSpec& spec)
    : body_(body),
      estimator_(estimator),
      spec_(spec),
      omega_(std::sqrt(body.gravity() / std::max(spec.stand_height, 0.1))),
      wish_(spec.walk) {
  forces_.fill(Vector3d::Zero());
}

void Trot::Begin(const QuadrupedReading& sensed, const PerLeg& rest) {
  Begin(sensed, rest, Vector3d::Zero(), kWait, 0);
}

void Trot::BeginToppling(const QuadrupedReading& sensed, const PerLeg& rest,
                         const Vector3d& rolling) {
  const Vector3d falls_to = CapturePoint(sensed, estimator_.v_WB_W(), omega_);
  Begin(sensed, rest, rolling, 0, NearerToFrontRight(sensed, falls_to) ? 0 : 0.5);
}

void Trot::Begin(const QuadrupedReading& sensed, const PerLeg& rest, const Vector3d& rolling,
                 double wait, double phase) {
  const Vector3d middle = (rest[0] + rest[1] + rest[2] + rest[3]) / 4;
  for (std::size_t leg = 0; leg < 4; ++leg) {
    rest_[leg] = Level(rest[leg] - middle);
    feet_[leg] = {.on = estimator_.p_WB() + sensed.R_WB * sensed.feet[leg]};
    forces_[leg] = body_.mass() * body_.gravity() / 4 * Vector3d::UnitZ();
  }
  ahead_.setZero();
  yaw_ahead_ = 0;
  height_ = estimator_.height();
  idle_ = 0;
  begins_ = true;
  ground_.Begin();
  wish_.Begin(Level(rolling));
  clock_.Begin(WantedGait(), wait, phase);
}

void Trot::Carry(double height, const Vector3d& rpy) {
  wanted_height_ = height;
  wanted_rpy_ = rpy;
}

GaitTiming Trot::WantedGait() const {
  const robot::WalkSpec& walk = spec_.walk;
  const double most = walk.most_speed[0];
  const double part = most > 0 ? std::min(wish_.velocity().head<2>().norm() / most, 1.0) : 0;
  return {.period = std::lerp(walk.period[0], walk.period[1], part),
          .duty = std::lerp(walk.duty[0], walk.duty[1], part),
          .raise = walk.foot_raise,
          .offsets = walk.offsets};
}

std::array<double, 4> Trot::stands() const {
  std::array<double, 4> stands{};
  for (std::size_t leg = 0; leg < 4; ++leg) {
    const double since = begins_ ? kTrustTime : clock_.stood(leg);
    const double until = clock_.halted() ? kTrustTime : clock_.stands_for(leg);
    if (clock_.stands(leg)) stands[leg] = std::clamp(std::min(since, until) / kTrustTime, 0.0, 1.0);
  }
  return stands;
}

void Trot::Step(const QuadrupedReading& sensed, double dt, LegCommand* legs) {
  wish_.Step(dt);
  See(sensed);
  Plan(dt);
  const bool idle = idle_ > (hurries_ ? kIdleHurried : kIdle);
  clock_.Advance(dt, WantedGait(), idle && Level(v_com_).norm() < kIdleSpeed);
  Watch(sensed);
  PerLeg stood;
  for (std::size_t leg = 0; leg < 4; ++leg) stood[leg] = feet_[leg].on;
  ground_.Update(stood, dt);
  Push(sensed, legs);
  for (std::size_t leg = 0; leg < 4; ++leg) {
    if (feet_[leg].swings) Swing(sensed, leg, legs);
  }
}

void Trot::See(const QuadrupedReading& sensed) {
  R_WT_ = sensed.R_WB * sensed.R_TB.transpose();
  const Vector3d arm = sensed.R_WB * sensed.com;
  com_ = estimator_.p_WB() + arm;
  v_com_ = estimator_.v_WB_W() + (sensed.R_WB * sensed.w_WB_B).cross(arm);
  turns_ = (sensed.R_TB * sensed.w_WB_B).z();
}

// How far the wanted way is ahead; more than the body may catch up with is forgotten.
void Trot::Plan(double dt) {
  ahead_ = NoLonger(ahead_ + dt * (R_WT_ * Level(wish_.velocity()) - Level(v_com_)), kAhead);
  yaw_ahead_ += dt * (wish_.velocity().z() - turns_);
  yaw_ahead_ = std::clamp(yaw_ahead_, -kYawAhead, kYawAhead);
  height_ += std::clamp(wanted_height_ - height_, -kRise * dt, kRise * dt);
  idle_ = wish_.at_rest() && !keeps_stepping_ ? idle_ + dt : 0;
}

// Which feet swing: by the clock, but a swing ends once the foot feels the ground.
void Trot::Watch(const QuadrupedReading& sensed) {
  for (std::size_t leg = 0; leg < 4; ++leg) {
    Foot& foot = feet_[leg];
    const bool felt = sensed.foot_force[leg] > kFelt * body_.mass() * body_.gravity();
    const Vector3d p = estimator_.p_WB() + sensed.R_WB * sensed.feet[leg];
    const bool landed = foot.swings && felt && clock_.swing_part(leg) > kMayLand;
    if (clock_.stands(leg) || landed) {
      foot.swings = false;
    } else if (!foot.swings && clock_.swing_part(leg) < kMayLift) {
      foot = {.swings = true, .felt = false, .from = p, .on = foot.on};
      begins_ = false;
    }
    if (foot.swings || !felt) continue;
    foot.felt = true;
    foot.on = p;
  }
}

double Trot::Load(std::size_t leg) const {
  if (feet_[leg].swings) return 0;
  if (!clock_.stands(leg) || clock_.halted()) return 1;
  const double since = begins_ ? kRampTime : clock_.stood(leg) + kLeastLoad * kRampTime;
  return std::clamp(std::min(since, clock_.stands_for(leg)) / kRampTime, kLeastLoad, 1.0);
}

Vector3d Trot::Acceleration() const {
  const Matrix3d R_TW = R_WT_.transpose();
  const Vector3d missing = Level(wish_.velocity()) - R_TW * Level(v_com_);
  const Vector3d push = omega_ * (omega_ * kPlaceGain * R_TW * ahead_ + kSpeedGain * missing) +
                        Level(wish_.acceleration());
  const double climb = ground_.slope().dot(v_com_);
  const double lift = omega_ * (omega_ * kHeight * (height_ - estimator_.height()) -
                                kLiftSpeed * (v_com_.z() - climb));
  return NoLonger(push, kMostPushed) +
         std::clamp(lift, -kMostLifted, kMostLifted) * Vector3d::UnitZ();
}

// The body is as level as the ground is, turned as it is to be carried.
Vector3d Trot::TurnRate(const QuadrupedReading& sensed) const {
  const Vector3d slope = R_WT_.transpose() * ground_.slope();
  const Vector3d rpy(wanted_rpy_.x() + std::atan(slope.y()), wanted_rpy_.y() - std::atan(slope.x()),
                     0);
  const Vector3d turn = RotationVector(FromRollPitchYaw(rpy) * sensed.R_TB.transpose());
  const Vector3d rate = sensed.R_TB * sensed.w_WB_B;
  Vector3d alpha = omega_ * (omega_ * kTilt * turn - kTiltRateGain * rate);
  alpha.z() = omega_ * (omega_ * kYaw * yaw_ahead_ + kYawRate * (wish_.velocity().z() - turns_));
  return Within(alpha, kMostTurn);
}

void Trot::Push(const QuadrupedReading& sensed, LegCommand* legs) {
  const double weight = body_.mass() * body_.gravity();
  ForceTask task{.friction = spec_.walk.friction,
                 .weight = weight,
                 .length = body_.leg_length(),
                 .last = forces_};
  task.force = body_.mass() * (Acceleration() + body_.gravity() * Vector3d::UnitZ());
  task.moment = sensed.R_TB * body_.Inertia(sensed) * sensed.R_TB.transpose() * TurnRate(sensed);
  PerLeg contacts;  // from the centre of mass, T
  for (std::size_t leg = 0; leg < 4; ++leg) {
    contacts[leg] = sensed.R_TB * (sensed.feet[leg] + sensed.soles[leg] - sensed.com);
    task.arms[leg] = contacts[leg];
    task.most[leg] = Load(leg) * kMostForce * weight;
    task.least[leg] = Load(leg) * kLeastForce * weight;
  }
  forces_ = ShareForces(task);

  const Matrix3d R_BT = sensed.R_TB.transpose();
  // Forces keep a body level that was pushed before they slow it down; the joints brake it at once,
  // soft ones by being led the faster.
  const double more = spec_.kd > 0 ? std::max(kBrake * spec_.kp / spec_.kd - 1, 0.0) : 0;
  const Vector3d missing = Level(wish_.velocity()) - R_WT_.transpose() * Level(v_com_);
  Vector3d v = Level(wish_.velocity()) + more * missing;
  v.z() = ground_.slope().dot(R_WT_ * v);
  const Vector3d w(0, 0, wish_.velocity().z());
  for (std::size_t leg = 0; leg < 4; ++leg) {
    if (feet_[leg].swings) continue;
    const LegPlaces& places = sensed.places[leg];
    const QuadrupedLeg& chain = body_.leg(leg);
    const Matrix3d jacobian = CalfJacobian(places, sensed.com + R_BT * contacts[leg]);
    const Vector3d slide = -(v + w.cross(contacts[leg]));  // of the ground against the body
    legs->q[leg] = sensed.q[leg];
    legs->dq[leg] = Within(JointRates(jacobian, R_BT * slide), kMostRate);
    legs->tau[leg] = chain.HoldingTorque(places, sensed.up, body_.gravity()) -
                     jacobian.transpose() * R_BT * forces_[leg] +
                     kFriction * chain.FrictionTorque(legs->dq[leg]);
  }
}

Vector3d Trot::Foothold(std::size_t leg) const {
  const Vector3d& wish = wish_.velocity();
  const Vector3d wanted = R_WT_ * Level(wish), v = Level(v_com_);
  const double left = clock_.swing_left(leg), half = clock_.stance_time() / 2;
  const Matrix3d R = AngleAxisd(wish.z() * (left + half), Vector3d::UnitZ()).toRotationMatrix();
  const Vector3d beyond = half * wanted + (v - wanted) / omega_ - kBehind * ahead_ +
                          v.cross(wish.z() * Vector3d::UnitZ()) / (2 * omega_ * omega_);
  Vector3d place =
      com_ + R_WT_ * R * rest_[leg] + left * v + NoLonger(beyond, kReach * body_.leg_length());
  place.z() = ground_.HeightAt(place) - kSink;
  return place;
}

void Trot::Swing(const QuadrupedReading& sensed, std::size_t leg, LegCommand* legs) const {
  const FootMotion foot = SwingFoot(feet_[leg].from, Foothold(leg), clock_.raise(),
                                    clock_.swing_time(), clock_.swing_part(leg));
  const QuadrupedLeg& chain = body_.leg(leg);
  const Matrix3d R_BW = sensed.R_WB.transpose();
  const Vector3d arm = R_BW * (foot.p - estimator_.p_WB());
  const Vector3d v = R_BW * (foot.v - estimator_.v_WB_W()) - sensed.w_WB_B.cross(arm);
  legs->q[leg] = chain.Angles(arm);
  const LegPlaces places = chain.Place(legs->q[leg]);
  const Matrix3d jacobian = FootJacobian(places);
  legs->dq[leg] = Within(JointRates(jacobian, v), kMostRate);
  constexpr double kMoment = 1e-4;  // s over which the Jacobian's change is taken
  const Matrix3d later = FootJacobian(chain.Place(legs->q[leg] + kMoment * legs->dq[leg]));
  const Vector3d a = R_BW * foot.a - (later - jacobian) / kMoment * legs->dq[leg];
  const Vector3d ddq = Within(JointRates(jacobian, a), kMostRateChange);
  legs->tau[leg] = chain.HoldingTorque(sensed.places[leg], sensed.up, body_.gravity()) +
                   chain.MassMatrix(places) * ddq + kFriction * chain.FrictionTorque(legs->dq[leg]);
}

}  // namespace understudy::motion
