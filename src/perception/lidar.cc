#include "perception/lidar.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include <mujoco/mujoco.h>

#include "mjcf/eigen_views.h"
#include "robot/rotations.h"
#include "sensors/chance.h"

namespace understudy::perception {
namespace {

using Eigen::Vector3d;

constexpr std::int64_t kSecond = 1'000'000'000;  // ns
constexpr double kRangeStep = 0.001;             // m, as the unit counts

// *Assumed*: how bright an echo is by its distance, and by how much it differs.
constexpr double kBrightest = 160, kDimming = 8 /* per m */, kFlicker = 12;

// Of the errors of a sample.
enum Error : std::uint64_t { kRange, kIntensity, kLoss, kErrors };

// Where a sample is lost to dirt on the window: in whole patches of it, *assumed* 10° wide.
std::uint64_t PatchOf(const Vector3d& ahead) {
  constexpr double kPatch = std::numbers::pi / 18;
  const double azimuth = std::atan2(ahead.y(), ahead.x()) + std::numbers::pi;
  const double elevation = std::asin(std::clamp(ahead.z(), -1.0, 1.0)) + std::numbers::pi;
  return static_cast<std::uint64_t>(azimuth / kPatch) * 64 +
         static_cast<std::uint64_t>(elevation / kPatch);
}

bool IsEcho(const robot::LidarPoint& point) { return point.x != 0 || point.y != 0 || point.z != 0; }

}  // namespace

Lidar::Lidar(const robot::LidarSpec& spec, const sensors::SensorConfig& errors, int body,
             const mjModel& model, const mjData& data, const RayCaster& rays, double dt)
    : spec_(spec),
      law_(LawOf(spec.make)),
      errors_(errors),
      body_(body),
      root_(model.body_rootid[body]),
      R_BL_(robot::FromRollPitchYaw(spec.rpy)) {
  const mjcf::RotationView R_WB(data.xmat + 9 * body);
  const Vector3d p_BS = spec.pos + R_BL_ * Vector3d(0, 0, law_.beam_start);
  housing_ = rays.Around(mjcf::Vector(data.xpos + 3 * body) + R_WB * p_BS);
  std::erase_if(housing_, [&](int geom) { return model.geom_bodyid[geom] != body; });
  slots_ = law_.slots_per_second * std::llround(dt * 1e9);
  const std::int64_t common = std::gcd(slots_, kSecond);
  slots_ /= common;
  steps_ = kSecond / common;
  const auto most = static_cast<std::size_t>(law_.cloud_samples);
  for (auto* const points :
       {&reading_.cloud.points, &filling_.points, &reading_.deskewed, &filling_deskewed_}) {
    points->reserve(most);
  }
}

void Lidar::Begin(std::int64_t slot) {
  if (sees_) {
    const auto echoes = std::ranges::count_if(filling_.points, IsEcho);
    reading_.status.points_hz = static_cast<double>(echoes) * law_.cloud_hz();
    std::swap(reading_.cloud, filling_);
    std::swap(reading_.deskewed, filling_deskewed_);
  }
  sees_ = true;
  filling_.points.clear();
  filling_deskewed_.clear();
  filling_.stamp_ns = slot * kSecond / law_.slots_per_second;
}

bool Lidar::Sense(std::int64_t step, const mjData& data, const RayCaster& rays,
                  const robot::LidarEffects& faults, const robot::LegOdometry* base) {
  const mjcf::RotationView R_WB(data.xmat + 9 * body_);
  p_WL_ = mjcf::Vector(data.xpos + 3 * body_) + R_WB * spec_.pos;
  R_WL_ = R_WB * R_BL_;
  bool complete = false;
  for (std::int64_t slot = SlotsUntil(step - 1) + 1; slot <= SlotsUntil(step); ++slot) {
    if (slot % law_.cloud_slots == 0) {
      complete = sees_;
      Begin(slot);
    }
    if (!sees_) continue;
    const Vector3d ahead = law_.look(slot);
    if (ahead.isZero(0)) continue;
    robot::LidarPoint point = Cast(slot, ahead, rays, faults);
    if (!law_.keeps_misses && !IsEcho(point)) continue;
    filling_.points.push_back(point);
    if (base == nullptr) continue;
    const Vector3d p_LP(point.x, point.y, point.z);
    const Vector3d at = base->p_OB + base->R_OB * (spec_.pos + R_BL_ * p_LP);
    point.x = static_cast<float>(at.x());
    point.y = static_cast<float>(at.y());
    point.z = static_cast<float>(at.z());
    filling_deskewed_.push_back(point);
  }
  return complete;
}

// Returns a point at 0 if no echo comes back.
robot::LidarPoint Lidar::Cast(std::int64_t slot, const Vector3d& ahead, const RayCaster& rays,
                              const robot::LidarEffects& faults) const {
  robot::LidarPoint point;
  point.time = static_cast<float>(static_cast<double>(slot % law_.cloud_slots) /
                                  static_cast<double>(law_.slots_per_second));
  const auto number = static_cast<std::uint64_t>(slot) * kErrors;
  const auto chance = [&](Error error) {
    return sensors::NoiseAt(errors_.seed, sensors::kLidarStream, number + error);
  };
  const double gain = errors_.noise ? errors_.noise_gain : 0;
  const double kept = (1 - gain * spec_.dropout) * (1 - faults.lost);
  if (faults.blind || (kept < 1 && sensors::ShareAt(errors_.seed, sensors::kLidarStream,
                                                    number + kLoss) < 1 - kept)) {
    return point;
  }
  if (faults.dirt > 0 &&
      sensors::ShareAt(errors_.seed, sensors::kLidarDirtStream, PatchOf(ahead)) < faults.dirt) {
    return point;
  }
  const Vector3d start(0, 0, law_.beam_start);
  const Hit hit = rays.Cast({p_WL_ + R_WL_ * start, R_WL_ * ahead}, housing_);
  if (!(hit.distance >= spec_.range[0] && hit.distance <= spec_.range[1])) return point;
  const double noise = std::hypot(gain * spec_.noise, faults.noise);
  double range = hit.distance + (noise > 0 ? noise * chance(kRange) : 0);
  if (errors_.quantise) range = kRangeStep * std::round(range / kRangeStep);
  const Vector3d at = start + range * ahead;
  const double intensity =
      std::round(kBrightest - kDimming * hit.distance + gain * kFlicker * chance(kIntensity));
  point.x = static_cast<float>(at.x());
  point.y = static_cast<float>(at.y());
  point.z = static_cast<float>(at.z());
  point.intensity = static_cast<float>(std::clamp(intensity, 0.0, 255.0));
  return point;
}

// As mj_objectAcceleration, at the lidar's origin: that of a unit a centimetre from there is
// *assumed* to be the same.
void Lidar::Feel(std::int64_t step, const mjData& data, const robot::ImuSpec& noise) {
  const mjcf::RotationView R_WB(data.xmat + 9 * body_);
  const Eigen::Matrix3d R_WL = R_WB * R_BL_;
  const Vector3d p_WL = mjcf::Vector(data.xpos + 3 * body_) + R_WB * spec_.pos;
  const mjtNum* const centre = data.subtree_com + 3 * root_;
  const Vector3d arm = p_WL - mjcf::Vector(centre);
  const Vector3d w = mjcf::Vector(data.cvel + 6 * body_);
  const Vector3d v = mjcf::Vector(data.cvel + 6 * body_ + 3) + w.cross(arm);
  const Vector3d a = mjcf::Vector(data.cacc + 6 * body_ + 3) +
                     mjcf::Vector(data.cacc + 6 * body_).cross(arm) + w.cross(v);
  reading_.imu.R_WI = R_WL;
  reading_.imu.w_WI_I = R_WL.transpose() * w;
  reading_.imu.f_WI_I = R_WL.transpose() * a;
  const double gain = errors_.noise ? errors_.noise_gain : 0;
  for (int i = 0; gain > 0 && i < 6; ++i) {
    const double error = gain * sensors::NoiseAt(errors_.seed, sensors::kLidarImuStream,
                                                 static_cast<std::uint64_t>(6 * step + i));
    (i < 3 ? reading_.imu.w_WI_I[i] : reading_.imu.f_WI_I[i - 3]) +=
        error * (i < 3 ? noise.gyro_noise : noise.accel_noise);
  }
}

}  // namespace understudy::perception
