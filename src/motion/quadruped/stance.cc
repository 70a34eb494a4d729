#include "motion/quadruped/stance.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "motion/joint_move.h"
#include "motion/rotations.h"

namespace understudy::motion {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// All assumed.
constexpr double kTrimTime = 0.8;        // s in which an error of the pose is taken back
constexpr double kTrimHeight = 0.06;     // m, most that it is taken back by
constexpr double kTrimRotation = 0.2;    // rad
constexpr double kHeightError = 0.02;    // m: more than this is a move under way, not an error
constexpr double kRotationError = 0.06;  // rad
constexpr double kHipClear = 0.2;        // of the leg's length over the ground
constexpr double kTrunkClear = 0.01;
constexpr double kKneeClear = 0.08;
constexpr double kHeightStep = 0.05;  // of the leg's length, of the search for a feasible pose
constexpr int kTilts = 20;            // from the wanted tilt down to none, of the same search
constexpr double kFollowRate = 8;     // rad/s, of the critically damped follower
constexpr double kArrived = 1e-9;     // m, rad and per s: nearer, and it is there

Vector3d Mean(const PerLeg& points) { return (points[0] + points[1] + points[2] + points[3]) / 4; }

}  // namespace

void Stance::Begin(const QuadrupedReading& reading) {
  PerLeg feet;
  for (std::size_t leg = 0; leg < feet.size(); ++leg) feet[leg] = reading.R_TB * reading.feet[leg];
  const Vector3d middle = Mean(feet);
  const Vector3d ahead = feet[0] + feet[1] - feet[2] - feet[3];
  const Matrix3d R_FT =
      AngleAxisd(-std::atan2(ahead.y(), ahead.x()), Vector3d::UnitZ()).toRotationMatrix();
  for (std::size_t leg = 0; leg < feet.size(); ++leg) {
    footprints_[leg] = R_FT * (feet[leg] - middle) + body_.radius() * Vector3d::UnitZ();
  }
  com_ = com_at_begin_ = reading.com;
  trim_height_ = 0;
  trim_rotation_.setZero();
  Measure(reading, 1);
  from_ = measured_;
  from_.place.head<2>() += (R_FB_ * com_).head<2>();
  held_ = to_ = from_;
  v_place_.setZero();
  v_rpy_.setZero();
  duration_ = elapsed_ = 0;
  fresh_ = true;
}

// The rotation about the vertical and the place that fit the feet to their footprints best, in the
// least squares of the plane.
void Stance::Measure(const QuadrupedReading& reading, double paw_load) {
  const std::array<double, 4> weight{paw_load, 1, 1, 1};
  Vector3d middle(0, 0, 0), print_middle(0, 0, 0);
  PerLeg feet;
  for (std::size_t leg = 0; leg < feet.size(); ++leg) {
    feet[leg] = reading.R_TB * reading.feet[leg];
    middle += weight[leg] * feet[leg] / (3 + paw_load);
    print_middle += weight[leg] * footprints_[leg] / (3 + paw_load);
  }
  double along = 0, across = 0;
  for (std::size_t leg = 0; leg < feet.size(); ++leg) {
    const Vector3d a = feet[leg] - middle, b = footprints_[leg] - print_middle;
    along += weight[leg] * (a.x() * b.x() + a.y() * b.y());
    across += weight[leg] * (a.x() * b.y() - a.y() * b.x());
  }
  const Matrix3d R_FT = AngleAxisd(std::atan2(across, along), Vector3d::UnitZ()).toRotationMatrix();
  R_FB_ = R_FT * reading.R_TB;
  measured_.place = print_middle - R_FT * middle;
  measured_.rpy = RollPitchYaw(R_FB_);
}

PerLeg Stance::FeetInBase(const StancePose& pose, const Vector3d& com) const {
  const Matrix3d R_FB = FromRollPitchYaw(pose.rpy);
  Vector3d base = pose.place;
  base.head<2>() -= (R_FB * com).head<2>();
  PerLeg feet;
  for (std::size_t leg = 0; leg < feet.size(); ++leg) {
    const Vector3d lift = leg == 0 ? pose.paw : Vector3d::Zero();
    feet[leg] = R_FB.transpose() * (footprints_[leg] + lift - base);
  }
  return feet;
}

bool Stance::CanHold(const StancePose& pose) const {
  PerLeg q;
  if (!body_.Reach(FeetInBase(pose, com_at_begin_), &q)) return false;
  const Vector3d up = FromRollPitchYaw(pose.rpy).row(2).transpose();
  if (pose.place.z() < body_.Depth(up) + kTrunkClear * body_.leg_length()) return false;
  for (std::size_t leg = 0; leg < q.size(); ++leg) {
    const double hip = pose.place.z() + up.dot(body_.leg(leg).figures().hip);
    const double knee = pose.place.z() + up.dot(body_.leg(leg).Place(q[leg]).calf);
    if (hip < kHipClear * body_.leg_length() || knee < kKneeClear * body_.leg_length())
      return false;
  }
  return true;
}

StancePose Stance::Feasible(const StancePose& wanted) const {
  constexpr int kHeights = 9;
  const double length = body_.leg_length();
  for (int tilt = 0; tilt < kTilts; ++tilt) {
    StancePose pose = wanted;
    pose.rpy *= 1 - static_cast<double>(tilt) / kTilts;
    for (int step = 0; step < kHeights; ++step) {
      for (const double direction : {-1.0, 1.0}) {
        pose.place.z() = wanted.place.z() + direction * step * kHeightStep * length;
        for (const double ahead : {0.0, 0.07, -0.07, 0.14, -0.14}) {
          pose.place.x() = wanted.place.x() + ahead * length;
          if (CanHold(pose)) return pose;
        }
      }
    }
  }
  return held_;
}

void Stance::MoveTo(const StancePose& pose, double duration) {
  from_ = held_;
  to_ = pose;
  duration_ = duration;
  elapsed_ = 0;
}

void Stance::Follow(const StancePose& pose) { to_ = pose; }

void Stance::Lead(double dt) {
  elapsed_ += dt;
  if (elapsed_ < duration_) {
    const double s = SmoothStep(elapsed_ / duration_);
    held_.place = from_.place + s * (to_.place - from_.place);
    held_.rpy = from_.rpy + s * (to_.rpy - from_.rpy);
    held_.paw = from_.paw + s * (to_.paw - from_.paw);
    held_.paw_load = from_.paw_load + s * (to_.paw_load - from_.paw_load);
    v_place_.setZero();
    v_rpy_.setZero();
    return;
  }
  const auto follow = [dt](const Vector3d& to, Vector3d* x, Vector3d* v) {
    // Without an end the rest would shrink for ever, into numbers with which a processor is slow.
    if ((to - *x).norm() < kArrived && v->norm() < kArrived) {
      *x = to;
      v->setZero();
      return;
    }
    *v += dt * kFollowRate * (kFollowRate * (to - *x) - 2 * *v);
    *x += dt * *v;
  };
  follow(to_.place, &held_.place, &v_place_);
  follow(to_.rpy, &held_.rpy, &v_rpy_);
  held_.paw = to_.paw;
  held_.paw_load = to_.paw_load;
}

void Stance::Step(const QuadrupedReading& sensed, double dt, LegCommand* legs) {
  Lead(dt);
  StancePose pose = held_;
  com_ = sensed.com;
  Measure(sensed, pose.paw_load);

  const Matrix3d R_wanted = FromRollPitchYaw(pose.rpy);
  const double rate = pose.paw_load / kTrimTime;  // on three feet a correction would rock it
  const auto trimmed = [dt, rate](double trim, double error, double most_error, double most) {
    return std::clamp(trim + dt * rate * std::clamp(error, -most_error, most_error), -most, most);
  };
  trim_height_ =
      trimmed(trim_height_, pose.place.z() - measured_.place.z(), kHeightError, kTrimHeight);
  const Vector3d turn = RotationVector(R_wanted * R_FB_.transpose());
  for (int i = 0; i < 3; ++i) {
    trim_rotation_[i] = trimmed(trim_rotation_[i], turn[i], kRotationError, kTrimRotation);
  }
  pose.place.z() += trim_height_;
  const double angle = trim_rotation_.norm();
  if (angle > 0) {
    pose.rpy =
        RollPitchYaw(AngleAxisd(angle, trim_rotation_ / angle).toRotationMatrix() * R_wanted);
  }
  legs->q = body_.Angles(FeetInBase(pose));
  legs->tau = body_.SupportTorque(sensed, {pose.paw_load, 1, 1, 1}, 1);
  for (std::size_t leg = 0; leg < last_q_.size(); ++leg) {
    legs->dq[leg] = fresh_ ? Vector3d::Zero() : Vector3d((legs->q[leg] - last_q_[leg]) / dt);
  }
  last_q_ = legs->q;
  fresh_ = false;
}

}  // namespace understudy::motion
