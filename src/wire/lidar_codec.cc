#include "wire/lidar_codec.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <lz4.h>

#include "wire/roll_pitch_yaw.h"
#include "wire/stamp.h"

namespace understudy::wire {
namespace {

char imu_of_lidar[] = "utlidar_imu", livox_of_imu[] = "livox_frame", base_of_range[] = "base_link",
     odom_of_map[] = "odom";
char no_version[] = "", software_version[] = "1.0.0.38";  // of a real one

constexpr double kGravity = 9.80665;          // m/s²
constexpr std::uint8_t kErrorOfCloud = 0x02;  // vendor, fault services
constexpr double kDirtPercent = 1;            // of a real one in use

double Seconds(const robot::LidarReading& reading) {
  return static_cast<double>(reading.now_ns - reading.since_ns) * 1e-9;
}

void EncodeMotion(const robot::LidarReading& reading, char* frame, double unit,
                  sensor_msgs_msg_dds__Imu_* message) {
  message->header.stamp = StampOf(reading.now_ns - reading.since_ns);
  message->header.frame_id = frame;
  const Eigen::Vector3d& w = reading.imu.w_WI_I;
  const Eigen::Vector3d f = reading.imu.f_WI_I / unit;
  message->angular_velocity = {.x = w.x(), .y = w.y(), .z = w.z()};
  message->linear_acceleration = {.x = f.x(), .y = f.y(), .z = f.z()};
}

}  // namespace

void EncodeLidarImu(const robot::LidarReading& reading, sensor_msgs_msg_dds__Imu_* message) {
  EncodeMotion(reading, imu_of_lidar, 1, message);
  const Eigen::Quaterniond& R =
      reading.imu.R_WI;  // NOLINT(readability-identifier-naming): a rotation
  message->orientation = {.x = R.x(), .y = R.y(), .z = R.z(), .w = R.w()};
}

void EncodeLivoxImu(const robot::LidarReading& reading, sensor_msgs_msg_dds__Imu_* message) {
  EncodeMotion(reading, livox_of_imu, kGravity, message);
  message->orientation = {.x = 0, .y = 0, .z = 0, .w = 1};
}

LidarStateEncoder::LidarStateEncoder(const robot::LidarSpec& spec)
    : scans_hz_(spec.make == "L2" ? 216 : 180),
      turns_hz_(spec.make == "L2" ? 5.55F : 11.01F),
      cloud_hz_(spec.make == "L2" ? 216.0F / 14 : 15) {}

void LidarStateEncoder::operator()(const robot::LidarReading& reading,
                                   unitree_go_msg_dds__LidarState_* message) const {
  const robot::LidarStatus& status = reading.status;
  constexpr float kImuHz = 250;
  message->stamp = message->serial_recv_stamp = Seconds(reading);
  message->firmware_version = message->sdk_version = no_version;
  message->software_version = software_version;
  message->sys_rotation_speed = turns_hz_;
  message->com_rotation_speed = scans_hz_;
  message->error_state = status.blind ? kErrorOfCloud : 0;
  message->dirty_percentage =
      static_cast<std::uint8_t>(std::lround(std::max(kDirtPercent, 100 * status.dirt)));
  message->cloud_frequency = cloud_hz_;
  message->cloud_size = static_cast<std::uint32_t>(std::lround(status.points_hz));
  message->cloud_scan_num = static_cast<std::uint32_t>(scans_hz_);
  message->imu_frequency = kImuHz;
  const Eigen::Vector3d rpy = RollPitchYaw(reading.imu.R_WI);
  for (int i = 0; i < 3; ++i) message->imu_rpy[i] = static_cast<float>(rpy[i]);
}

void EncodeClearance(const robot::LidarReading& reading,
                     geometry_msgs_msg_dds__PointStamped_* message) {
  message->header.stamp = StampOf(reading.now_ns - reading.since_ns);
  message->header.frame_id = base_of_range;
  message->point = {.x = reading.clear.x(), .y = reading.clear.y(), .z = reading.clear.z()};
}

void EncodeHeightMap(const robot::LidarReading& reading, unitree_go_msg_dds__HeightMap_* message) {
  const robot::HeightMap& map = reading.map;
  message->stamp = Seconds(reading);
  message->frame_id = odom_of_map;
  message->resolution = static_cast<float>(robot::HeightMap::kCell);
  message->width = message->height = robot::HeightMap::kCells;
  for (int i = 0; i < 2; ++i) message->origin[i] = static_cast<float>(map.origin[i]);
  const auto count = static_cast<std::uint32_t>(map.heights.size());
  // The message only reads them.
  message->data = {count, count, const_cast<float*>(map.heights.data()), false};
}

VoxelMapEncoder::VoxelMapEncoder()
    : block_(LZ4_COMPRESSBOUND(robot::VoxelMap::kAcross * robot::VoxelMap::kAcross *
                               robot::VoxelMap::kUp / 8)) {}

void VoxelMapEncoder::operator()(const robot::LidarReading& reading,
                                 unitree_go_msg_dds__VoxelMapCompressed_* message) {
  const robot::VoxelMap& map = reading.voxels;
  message->stamp = Seconds(reading);
  message->frame_id = odom_of_map;
  message->resolution = robot::VoxelMap::kCell;
  std::copy_n(map.origin.data(), 3, message->origin);
  message->width[0] = message->width[1] = robot::VoxelMap::kAcross;
  message->width[2] = robot::VoxelMap::kUp;
  message->src_size = map.bits.size();
  const auto text = [](const std::uint8_t* bytes) { return reinterpret_cast<const char*>(bytes); };
  const int size =
      LZ4_compress_default(text(map.bits.data()), const_cast<char*>(text(block_.data())),
                           static_cast<int>(map.bits.size()), static_cast<int>(block_.size()));
  const auto count = static_cast<std::uint32_t>(size);
  message->data = {count, count, block_.data(), false};
}

void EncodeMapState(const robot::LidarReading& reading,
                    unitree_go_msg_dds__VoxelHeightMapState_* message) {
  message->stamp = message->stamp_odom = Seconds(reading);
  message->stamp_cloud = static_cast<double>(reading.cloud.stamp_ns - reading.since_ns) * 1e-9;
  message->height_map_size = static_cast<std::uint32_t>(std::ranges::count_if(
      reading.map.heights, [](float height) { return height < robot::HeightMap::kUnseen; }));
  message->voxel_map_size = 0;
  for (const std::uint8_t eight : reading.voxels.bits) {
    message->voxel_map_size += static_cast<std::uint32_t>(std::popcount(eight));
  }
}

}  // namespace understudy::wire
