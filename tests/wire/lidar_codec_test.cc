#include "wire/lidar_codec.h"

#include <vector>

#include <gtest/gtest.h>
#include <lz4.h>

namespace understudy::wire {
namespace {

class LidarCodecTest : public testing::Test {
 protected:
  robot::LidarReading reading_{.since_ns = 1'000'000'000, .now_ns = 13'004'000'000};
};

TEST_F(LidarCodecTest, HasTheUnitsAxesAndAttitude) {
  reading_.imu = {.R_WI = {0.5, 0.5, -0.5, 0.5}, .w_WI_I = {1, 2, 3}, .f_WI_I = {4, 5, -9}};
  sensor_msgs_msg_dds__Imu_ message{};
  EncodeLidarImu(reading_, &message);
  EXPECT_EQ(message.header.stamp.sec, 12);
  EXPECT_EQ(message.header.stamp.nanosec, 4'000'000U);
  EXPECT_STREQ(message.header.frame_id, "utlidar_imu");
  EXPECT_EQ(message.orientation.w, 0.5);
  EXPECT_EQ(message.orientation.y, -0.5);
  EXPECT_EQ(message.angular_velocity.z, 3);
  EXPECT_EQ(message.linear_acceleration.z, -9);
  for (const double zero : message.linear_acceleration_covariance) EXPECT_EQ(zero, 0);
}

TEST_F(LidarCodecTest, HasALivoxUnitInG) {
  reading_.imu.f_WI_I = {0, 0, -9.80665};
  sensor_msgs_msg_dds__Imu_ message{};
  EncodeLivoxImu(reading_, &message);
  EXPECT_STREQ(message.header.frame_id, "livox_frame");
  EXPECT_DOUBLE_EQ(message.linear_acceleration.z, -1);
  EXPECT_EQ(message.orientation.w, 1);
}

TEST_F(LidarCodecTest, HasTheRatesOfItsMake) {
  reading_.status.points_hz = 21'168;
  unitree_go_msg_dds__LidarState_ message{};
  LidarStateEncoder(robot::LidarSpec{.make = "L1"})(reading_, &message);
  EXPECT_DOUBLE_EQ(message.stamp, 12.004);
  EXPECT_STREQ(message.software_version, "1.0.0.38");
  EXPECT_STREQ(message.firmware_version, "");
  EXPECT_EQ(message.cloud_frequency, 15);
  EXPECT_EQ(message.cloud_scan_num, 180U);
  EXPECT_EQ(message.cloud_size, 21'168U);
  EXPECT_EQ(message.imu_frequency, 250);
  EXPECT_EQ(message.error_state, 0);
  EXPECT_EQ(message.dirty_percentage, 1);
  LidarStateEncoder(robot::LidarSpec{.make = "L2"})(reading_, &message);
  EXPECT_NEAR(message.cloud_frequency, 15.43, 0.01);
  EXPECT_EQ(message.cloud_scan_num, 216U);
}

TEST_F(LidarCodecTest, ReportsFaults) {
  reading_.status = {.blind = true, .dirt = 0.83};
  unitree_go_msg_dds__LidarState_ message{};
  LidarStateEncoder(robot::LidarSpec{.make = "L1"})(reading_, &message);
  EXPECT_EQ(message.error_state, 2);
  EXPECT_EQ(message.dirty_percentage, 83);
}

TEST_F(LidarCodecTest, HasDistancesInTheBase) {
  reading_.clear = {1.95, 1.05, 0.5};
  geometry_msgs_msg_dds__PointStamped_ message{};
  EncodeClearance(reading_, &message);
  EXPECT_STREQ(message.header.frame_id, "base_link");
  EXPECT_EQ(message.point.x, 1.95);
  EXPECT_EQ(message.point.y, 1.05);
  EXPECT_EQ(message.point.z, 0.5);
}

TEST_F(LidarCodecTest, HasTheMapOfTheVendorsPage) {
  reading_.map = {.origin = {-3.84, -3.78}, .heights = std::vector<float>(128 * 128, 1e9F)};
  reading_.map.heights[128 * 3 + 5] = 0.25F;
  unitree_go_msg_dds__HeightMap_ message{};
  EncodeHeightMap(reading_, &message);
  EXPECT_DOUBLE_EQ(message.stamp, 12.004);
  EXPECT_STREQ(message.frame_id, "odom");
  EXPECT_EQ(message.resolution, 0.06F);
  EXPECT_EQ(message.width, 128U);
  EXPECT_EQ(message.height, 128U);
  EXPECT_EQ(message.origin[1], -3.78F);
  ASSERT_EQ(message.data._length, 128U * 128U);
  EXPECT_EQ(message.data._buffer[128 * 3 + 5], 0.25F) << "x first";
  EXPECT_EQ(message.data._buffer[0], 1e9F);
}

TEST_F(LidarCodecTest, HasVoxelsAsABlockOfLz4) {
  reading_.voxels = {.origin = {-3.625, -3.275, -0.575},
                     .bits = std::vector<std::uint8_t>(128 * 128 * 38 / 8)};
  reading_.voxels.bits[2048 * 3 + 16 * 5 + 1] = 0x81;
  VoxelMapEncoder encode;
  unitree_go_msg_dds__VoxelMapCompressed_ message{};
  encode(reading_, &message);
  EXPECT_DOUBLE_EQ(message.stamp, 12.004);
  EXPECT_STREQ(message.frame_id, "odom");
  EXPECT_EQ(message.resolution, 0.05);
  EXPECT_EQ(message.origin[1], -3.275);
  EXPECT_EQ(message.width[0], 128);
  EXPECT_EQ(message.width[2], 38);
  EXPECT_EQ(message.src_size, 77824U);
  EXPECT_LT(message.data._length, 1000U);
  std::vector<std::uint8_t> bits(message.src_size);
  const auto text = [](std::uint8_t* bytes) { return reinterpret_cast<char*>(bytes); };
  EXPECT_EQ(LZ4_decompress_safe(text(message.data._buffer), text(bits.data()),
                                static_cast<int>(message.data._length), 77824),
            77824);
  EXPECT_EQ(bits, reading_.voxels.bits);
}

TEST_F(LidarCodecTest, HasVoxelsThatDoNotCompress) {
  reading_.voxels.bits.resize(77824);
  std::uint32_t state = 1;
  for (std::uint8_t& bits : reading_.voxels.bits) {
    state = state * 1664525 + 1013904223;
    bits = static_cast<std::uint8_t>(state >> 24);
  }
  VoxelMapEncoder encode;
  unitree_go_msg_dds__VoxelMapCompressed_ message{};
  encode(reading_, &message);
  EXPECT_GT(message.data._length, 77000U);
  EXPECT_EQ(message.src_size, 77824U);
}

TEST_F(LidarCodecTest, CountsTheCellsThatAreKnownAndTheCubesThatAreFull) {
  reading_.cloud.stamp_ns = reading_.now_ns - 100'000'000;
  reading_.map.heights = {0.25F, robot::HeightMap::kUnseen, -0.1F, robot::HeightMap::kUnseen};
  reading_.voxels.bits = {0x81, 0x00, 0x07};
  unitree_go_msg_dds__VoxelHeightMapState_ message{};
  for (int i = 0; i < 2; ++i) EncodeMapState(reading_, &message);
  EXPECT_DOUBLE_EQ(message.stamp, 12.004);
  EXPECT_DOUBLE_EQ(message.stamp_odom, 12.004);
  EXPECT_DOUBLE_EQ(message.stamp_cloud, 11.904);
  EXPECT_EQ(message.height_map_size, 2U);
  EXPECT_EQ(message.voxel_map_size, 5U);
}

}  // namespace
}  // namespace understudy::wire
