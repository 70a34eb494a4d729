#include "wire/cloud_codec.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <span>

#include "robot/rotations.h"
#include "wire/stamp.h"

namespace understudy::wire {
namespace {

constexpr std::uint8_t kUint8 = 2, kUint16 = 4, kFloat32 = 7, kFloat64 = 8;  // PointField's

char x_name[] = "x", y_name[] = "y", z_name[] = "z", intensity_name[] = "intensity",
     ring_name[] = "ring", time_name[] = "time", tag_name[] = "tag", line_name[] = "line",
     timestamp_name[] = "timestamp";
// The first four are those of cloud_deskewed.
sensor_msgs_msg_dds__PointField_ cloud_fields[] = {
    {x_name, 0, kFloat32, 1},          {y_name, 4, kFloat32, 1},    {z_name, 8, kFloat32, 1},
    {intensity_name, 16, kFloat32, 1}, {ring_name, 20, kUint16, 1}, {time_name, 24, kFloat32, 1}};
constexpr std::size_t kPointBytes = 32;
// Between the fields a real one's memory shows.
constexpr std::size_t kGap = 12, kTail = 28;
constexpr std::uint8_t kLeftOver = 0x7F;

sensor_msgs_msg_dds__PointField_ livox_fields[] = {
    {x_name, 0, kFloat32, 1},          {y_name, 4, kFloat32, 1},  {z_name, 8, kFloat32, 1},
    {intensity_name, 12, kFloat32, 1}, {tag_name, 16, kUint8, 1}, {line_name, 17, kUint8, 1},
    {timestamp_name, 18, kFloat64, 1}};
constexpr std::size_t kLivoxPointBytes = 26, kLivoxLines = 4;

char lidar_of_cloud[] = "utlidar_lidar", base_of_cloud[] = "base_link", odom_of_cloud[] = "odom",
     livox_of_cloud[] = "livox_frame";

template <class Value>
void Put(Value value, std::size_t offset, std::uint8_t* point) {
  std::memcpy(point + offset, &value, sizeof value);
}

void PutPlace(const Eigen::Vector3f& at, std::uint8_t* point) {
  for (int axis = 0; axis < 3; ++axis) Put(at[axis], 4 * static_cast<std::size_t>(axis), point);
}

// The last sample's: derived from stamps of real clouds, as that of cloud_deskewed.
std::int64_t EndOf(const robot::PointCloud& cloud) {
  const double last = cloud.points.empty() ? 0 : static_cast<double>(cloud.points.back().time);
  return cloud.stamp_ns + static_cast<std::int64_t>(last * 1e9);
}

}  // namespace

CloudEncoder::CloudEncoder(Content content, const robot::LidarSpec& spec)
    : content_(content),
      livox_(!robot::IsMapped(spec)),
      R_BL_(robot::FromRollPitchYaw(spec.rpy).cast<float>()),
      p_BL_(spec.base_pos.cast<float>()),
      point_bytes_(livox_ ? kLivoxPointBytes : kPointBytes) {}

void CloudEncoder::PutUnitree(const robot::LidarReading& reading) {
  const bool base = content_ == Content::kCloudBase, deskewed = content_ == Content::kCloudDeskewed;
  const auto& points = deskewed ? reading.deskewed : reading.cloud.points;
  const std::size_t every = base ? 2 : 1;
  const std::size_t count = (points.size() + every - 1) / every;
  bytes_.assign((deskewed ? std::max(count, kDeskewedPoints) : count) * kPointBytes, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const robot::LidarPoint& point = points[i * every];
    const Eigen::Vector3f seen(point.x, point.y, point.z);
    std::uint8_t* const bytes = bytes_.data() + i * kPointBytes;
    PutPlace(base ? Eigen::Vector3f(R_BL_ * seen + p_BL_) : seen, bytes);
    Put(point.intensity, 16, bytes);
    if (deskewed) continue;
    bytes[kGap] = kLeftOver;
    Put(point.time, 24, bytes);
    if (base) bytes[kTail] = kLeftOver;
  }
}

void CloudEncoder::PutLivox(const robot::LidarReading& reading) {
  const auto& points = reading.cloud.points;
  bytes_.assign(points.size() * kLivoxPointBytes, 0);
  const auto begin = static_cast<double>(reading.cloud.stamp_ns - reading.since_ns);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const robot::LidarPoint& point = points[i];
    std::uint8_t* const bytes = bytes_.data() + i * kLivoxPointBytes;
    PutPlace({point.x, point.y, point.z}, bytes);
    Put(point.intensity, 12, bytes);
    bytes[17] = static_cast<std::uint8_t>(i % kLivoxLines);
    Put(begin + 1e9 * static_cast<double>(point.time), 18, bytes);
  }
}

void CloudEncoder::operator()(const robot::LidarReading& reading,
                              sensor_msgs_msg_dds__PointCloud2_* message) {
  livox_ ? PutLivox(reading) : PutUnitree(reading);
  const bool deskewed = content_ == Content::kCloudDeskewed;
  const std::span<sensor_msgs_msg_dds__PointField_> fields = livox_ ? std::span(livox_fields)
                                                             : deskewed
                                                                 ? std::span(cloud_fields).first(4)
                                                                 : std::span(cloud_fields);
  message->header.stamp =
      StampOf((deskewed ? EndOf(reading.cloud) : reading.cloud.stamp_ns) - reading.since_ns);
  message->header.frame_id = livox_                            ? livox_of_cloud
                             : deskewed                        ? odom_of_cloud
                             : content_ == Content::kCloudBase ? base_of_cloud
                                                               : lidar_of_cloud;
  message->height = 1;
  message->width = static_cast<std::uint32_t>(bytes_.size() / point_bytes_);
  const auto count = static_cast<std::uint32_t>(fields.size());
  message->fields = {count, count, fields.data(), false};
  message->point_step = static_cast<std::uint32_t>(point_bytes_);
  message->row_step = static_cast<std::uint32_t>(bytes_.size());
  message->data = {message->row_step, message->row_step, bytes_.data(), false};
  message->is_dense = true;
}

}  // namespace understudy::wire
