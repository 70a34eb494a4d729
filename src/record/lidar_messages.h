// Reads what lidars, and the programs that map what they see, say in messages.
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "record/bytes.h"

namespace understudy::record {

// All take a message in the form of CdrSample::bytes(), of the robot or of a stranger, and throw
// RecordError for one that is not of the type, or not little-endian XCDR1.

// Returns the points [m] of a sensor_msgs/PointCloud2, in its frame. Points without an echo are
// left out: at 0, 0, 0 or not finite. Throws RecordError also for big-endian clouds, and for clouds
// whose x, y and z are not float32.
std::vector<Eigen::Vector3f> ReadPointCloud(ByteSpan message);

// Returns the cells of a unitree_go/HeightMap that were seen, in its frame: x, y, height [m].
std::vector<Eigen::Vector3f> ReadHeightMap(ByteSpan message);

// Returns the pose [m] of a geometry_msgs/PoseStamped.
Eigen::Isometry3d ReadPose(ByteSpan message);

}  // namespace understudy::record
