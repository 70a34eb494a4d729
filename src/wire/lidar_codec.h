// Encodes what a lidar says beside its clouds.
#pragma once

#include <cstdint>
#include <vector>

#include "idl/geometry_msgs.h"
#include "idl/sensor_msgs.h"
#include "idl/unitree_go.h"
#include "robot/lidar_reading.h"
#include "robot/robot_spec.h"

namespace understudy::wire {

// Stamps are simulated time since the robot was switched on. What the messages point to lives as
// long as the reading.

// In the lidar's axes, m/s²; covariances are 0 (seen).
void EncodeLidarImu(const robot::LidarReading& reading, sensor_msgs_msg_dds__Imu_* message);
// In units of g, as a G1's (measured). That it has no attitude is *assumed*.
void EncodeLivoxImu(const robot::LidarReading& reading, sensor_msgs_msg_dds__Imu_* message);

// Rates and speeds are those of the make. A blind lidar sets 0x02 of error_state, its error of the
// cloud. *Assumed*: all that real ones have not shown, the buffers among it, which are 0.
class LidarStateEncoder {
 public:
  explicit LidarStateEncoder(const robot::LidarSpec& spec);
  void operator()(const robot::LidarReading& reading,
                  unitree_go_msg_dds__LidarState_* message) const;

 private:
  float scans_hz_, turns_hz_, cloud_hz_;
};

// x ahead, y to the left, z to the right, m.
void EncodeClearance(const robot::LidarReading& reading,
                     geometry_msgs_msg_dds__PointStamped_* message);
// Heights in odom, 1e9 where nothing was seen (vendor's page).
void EncodeHeightMap(const robot::LidarReading& reading, unitree_go_msg_dds__HeightMap_* message);

// Cubes in odom, as a block of LZ4 without a frame (as unitree_webrtc_connect and go2_ros2_sdk read
// it).
class VoxelMapEncoder {
 public:
  VoxelMapEncoder();
  void operator()(const robot::LidarReading& reading,
                  unitree_go_msg_dds__VoxelMapCompressed_* message);

 private:
  std::vector<std::uint8_t> block_;  // what the message points to
};

// *Assumed*: that its sizes count the cells whose height is known and the cubes that are full; that
// its stamps are those of the message, of the newest cloud in the maps and of the odometry.
void EncodeMapState(const robot::LidarReading& reading,
                    unitree_go_msg_dds__VoxelHeightMapState_* message);

}  // namespace understudy::wire
