// Encodes clouds of a lidar.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "idl/sensor_msgs.h"
#include "robot/lidar_reading.h"
#include "robot/robot_spec.h"
#include "wire/robot_topics.h"

namespace understudy::wire {

// Encodes as real ones do, to the byte (docs/seeing.md):
//   kCloud          all points, in the lidar's frame; a Mid-360's in Livox' layout
//   kCloudBase      every other point (*assumed*: a real one leaves out as many, the rule is
//                   unknown), in base_link
//   kCloudDeskewed  all points, in odom, and points at 0 up to kDeskewedPoints
// After the largest cloud so far nothing is allocated.
class CloudEncoder {
 public:
  // Measured, of a Go2. Where among the others the points at 0 stand is *assumed*: behind them.
  static constexpr std::size_t kDeskewedPoints = 10'720;

  CloudEncoder(Content content, const robot::LidarSpec& spec);

  // What `message` points to belongs to the encoder until the next call.
  void operator()(const robot::LidarReading& reading, sensor_msgs_msg_dds__PointCloud2_* message);

 private:
  void PutUnitree(const robot::LidarReading& reading);
  void PutLivox(const robot::LidarReading& reading);

  Content content_;
  bool livox_;
  Eigen::Matrix3f R_BL_;
  Eigen::Vector3f p_BL_;  // m
  std::size_t point_bytes_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace understudy::wire
