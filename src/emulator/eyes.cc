#include "emulator/eyes.h"

#include <algorithm>
#include <cmath>

#include "robot/rotations.h"

namespace understudy::emulator {
namespace {

using wire::Content;

bool IsOfClouds(Content content) {
  return content != Content::kImuOfLidar && content != Content::kStateOfLidar;
}
bool IsMap(Content content) {
  return content == Content::kHeightMap || content == Content::kVoxelMap ||
         content == Content::kMapState;
}
bool ComesWithClouds(Content content) { return IsOfClouds(content) && !IsMap(content); }

int BodyOf(const robot::RobotSpec& spec, const physics::RobotBody& body) {
  return body.Body(spec.lidar.body.empty() ? spec.base_body : spec.lidar.body);
}

}  // namespace

Eyes::Eyes(const robot::RobotSpec& spec, const sensors::SensorConfig& errors,
           const physics::MujocoWorld& physics, const physics::RobotBody& body,
           const perception::RayCaster& rays)
    : spec_(spec),
      step_ns_(std::llround(physics.timestep() * 1e9)),
      R_BL_(robot::FromRollPitchYaw(spec.lidar.rpy)),
      lidar_(spec.lidar, errors, BodyOf(spec, body), physics.model(), physics.data(), rays,
             physics.timestep()) {
  for (const wire::LidarMessage& message : wire::LidarMessages(spec)) {
    parts_.push_back({message.content, robot::Rate(message.topic.hz, physics.timestep())});
  }
  constexpr auto kCells = static_cast<std::size_t>(robot::HeightMap::kCells);
  lidar_.reading().map.heights.reserve(kCells * kCells);
}

bool Eyes::Wants(Content content) const {
  return std::ranges::any_of(
      parts_, [content](const Part& part) { return part.content == content && part.wanted; });
}

void Eyes::Rest() {
  lidar_.Rest();
  if (mapped_) heights_.Clear();
  voxels_.Clear();
  mapped_ = false;
  clearance_.Clear();
}

void Eyes::Look(std::int64_t step, const mjData& data, const robot::LidarEffects& faults,
                perception::RayCaster* rays, Computer* computer) {
  const bool runs = !faults.dead && computer->RunsLidar();
  looks_ = runs && computer->LooksForObstacles();
  bool casts = looks_;
  for (Part& part : parts_) {
    part.wanted = runs && computer->WantsLidar(part.content);
    casts = casts || (part.wanted && IsOfClouds(part.content));
  }
  robot::LidarReading& reading = lidar_.reading();
  reading.now_ns = step * step_ns_;
  if (!looks_) ForgetObstacles(computer);
  if (casts) {
    Cast(step, data, faults, rays, computer);
  } else {
    Rest();
  }
  for (const Part& part : parts_) {
    if (!part.wanted || ComesWithClouds(part.content) || !part.rate.Due(step)) continue;
    if (part.content == Content::kHeightMap || part.content == Content::kMapState) {
      heights_.Read(&reading.map);
    }
    if (part.content == Content::kVoxelMap || part.content == Content::kMapState) {
      voxels_.Read(&reading.voxels);
    }
    if (!IsMap(part.content)) lidar_.Feel(step, data, spec_.imu);
    reading.status.blind = faults.blind;
    reading.status.dirt = faults.dirt;
    if (!casts) reading.status.points_hz = lidar_.nominal_points_hz();
    computer->Publish(part.content, &reading);
  }
}

void Eyes::Cast(std::int64_t step, const mjData& data, const robot::LidarEffects& faults,
                perception::RayCaster* rays, Computer* computer) {
  rays->Follow(step, data);
  const auto& odometry = computer->sampled().leg_odometry;
  const robot::LegOdometry* const base = odometry ? &*odometry : nullptr;
  const bool maps = std::ranges::any_of(
      parts_, [](const Part& part) { return part.wanted && IsMap(part.content); });
  const bool deskews = maps || looks_ || Wants(Content::kCloudDeskewed);
  if (!lidar_.Sense(step, data, *rays, faults, deskews ? base : nullptr)) return;
  const robot::LidarReading& reading = lidar_.reading();
  const bool deskewed = reading.deskewed.size() == reading.cloud.points.size();
  if (maps && base != nullptr && deskewed) Map(*base);
  if (looks_ && base != nullptr && deskewed) FindObstacles(*base, computer);
  if (Wants(Content::kClearance) && base != nullptr) Measure(*base);
  for (const Part& part : parts_) {
    const bool made = part.content == Content::kCloudDeskewed ? deskewed
                      : part.content == Content::kClearance   ? base != nullptr
                                                              : ComesWithClouds(part.content);
    if (part.wanted && made) computer->Publish(part.content, &lidar_.reading());
  }
}

Eigen::Vector3d Eyes::InBase(const robot::LidarPoint& point) const {
  return spec_.lidar.pos + R_BL_ * Eigen::Vector3d(point.x, point.y, point.z);
}

void Eyes::Map(const robot::LegOdometry& base) {
  mapped_ = true;
  const bool voxels = Wants(Content::kVoxelMap) || Wants(Content::kMapState);
  heights_.Follow(base.p_OB.head<2>());
  if (voxels) {
    voxels_.Begin(base.p_OB.head<2>());
  } else {
    voxels_.Clear();
  }
  const robot::LidarReading& reading = lidar_.reading();
  for (std::size_t i = 0; i < reading.deskewed.size(); ++i) {
    const robot::LidarPoint& at = reading.deskewed[i];
    if (perception::IsOfRobot(InBase(reading.cloud.points[i]), base.p_OB.z())) continue;
    heights_.Add({at.x, at.y, at.z});
    if (voxels) voxels_.Add({at.x, at.y, at.z});
  }
}

void Eyes::FindObstacles(const robot::LegOdometry& base, Computer* computer) {
  const auto& motion = computer->sampled().motion;
  obstacles_.Begin(base, motion ? motion->p_WB.z() : 0);
  const robot::LidarReading& reading = lidar_.reading();
  for (std::size_t i = 0; i < reading.deskewed.size(); ++i) {
    const robot::LidarPoint& at = reading.deskewed[i];
    obstacles_.Add({at.x, at.y, at.z}, InBase(reading.cloud.points[i]));
  }
  obstacles_.Read(&seen_);
  computer->See(seen_);
}

void Eyes::ForgetObstacles(Computer* computer) {
  if (!seen_.known) return;
  obstacles_.Clear();
  seen_ = {};
  computer->See(seen_);
}

void Eyes::Measure(const robot::LegOdometry& base) {
  robot::LidarReading& reading = lidar_.reading();
  const std::vector<robot::LidarPoint>& points = reading.cloud.points;
  clearance_.Add(
      points.size(), [&](std::size_t i) { return InBase(points[i]); }, base.p_OB.z());
  reading.clear = clearance_.Read();
}

}  // namespace understudy::emulator
