#include "wire/cloud_codec.h"

#include <cstddef>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "config/load.h"
#include "robot/rotations.h"
#include "tests/support/allocations.h"

namespace understudy::wire {
namespace {

using ::testing::ElementsAre;

class CloudCodecTest : public testing::Test {
 protected:
  std::vector<std::uint8_t> Point(const sensor_msgs_msg_dds__PointCloud2_& message,
                                  std::size_t i) const {
    const std::uint8_t* const point = message.data._buffer + i * message.point_step;
    return {point, point + message.point_step};
  }
  float Value(const sensor_msgs_msg_dds__PointCloud2_& message, std::size_t i,
              std::size_t offset) const {
    float value = 0;
    std::memcpy(&value, Point(message, i).data() + offset, sizeof value);
    return value;
  }

  robot::LidarSpec spec_ =
      config::LoadConfig({.robot = "go2"}, UNDERSTUDY_SOURCE_DIR).robots[0].spec.lidar;
  // Of the cloud.
  const sensor_msgs_msg_dds__PointCloud2_& Encoded(Content content) {
    encoder_.emplace(content, spec_);
    (*encoder_)(reading_, &message_);
    return message_;
  }

  std::optional<CloudEncoder> encoder_;
  sensor_msgs_msg_dds__PointCloud2_ message_{};
  robot::LidarReading reading_{.since_ns = 1'000'000'000};
  robot::PointCloud& cloud_ =
      reading_.cloud = {.stamp_ns = 13'066'666'666,
                        .points = {{.x = 1, .y = 2, .z = 3, .intensity = 132, .time = 0.5},
                                   {.x = 4, .y = 5, .z = 6, .intensity = 109, .time = 0.75},
                                   {.x = 7, .y = 8, .z = 9, .intensity = 118, .time = 1}}};
};

TEST_F(CloudCodecTest, HasTheFieldsAndPaddingOfARealOne) {
  const auto& message = Encoded(Content::kCloud);
  EXPECT_EQ(message.header.stamp.sec, 12);
  EXPECT_EQ(message.header.stamp.nanosec, 66'666'666U);
  EXPECT_STREQ(message.header.frame_id, "utlidar_lidar");
  EXPECT_EQ(message.height, 1U);
  EXPECT_EQ(message.width, 3U);
  EXPECT_EQ(message.point_step, 32U);
  EXPECT_EQ(message.row_step, 96U);
  EXPECT_EQ(message.data._length, 96U);
  EXPECT_FALSE(message.is_bigendian);
  EXPECT_TRUE(message.is_dense);
  std::vector<std::string> fields;
  for (std::uint32_t i = 0; i < message.fields._length; ++i) {
    const auto& field = message.fields._buffer[i];
    fields.push_back(std::string(field.name) + " " + std::to_string(field.offset) + " " +
                     std::to_string(field.datatype) + " " + std::to_string(field.count));
  }
  EXPECT_THAT(fields, ElementsAre("x 0 7 1", "y 4 7 1", "z 8 7 1", "intensity 16 7 1",
                                  "ring 20 4 1", "time 24 7 1"));
  EXPECT_EQ(Value(message, 1, 0), 4);
  EXPECT_EQ(Value(message, 1, 4), 5);
  EXPECT_EQ(Value(message, 1, 8), 6);
  EXPECT_EQ(Value(message, 1, 16), 109);
  EXPECT_EQ(Value(message, 1, 24), 0.75F);
  const auto point = Point(message, 1);
  EXPECT_THAT(std::vector(point.begin() + 12, point.begin() + 16), ElementsAre(0x7F, 0, 0, 0));
  EXPECT_THAT(std::vector(point.begin() + 20, point.begin() + 24), ElementsAre(0, 0, 0, 0));
  EXPECT_THAT(std::vector(point.begin() + 28, point.end()), ElementsAre(0, 0, 0, 0));
}

TEST_F(CloudCodecTest, HasEveryOtherPointInCloudBaseTurnedIntoTheBase) {
  const auto& message = Encoded(Content::kCloudBase);
  EXPECT_STREQ(message.header.frame_id, "base_link");
  EXPECT_EQ(message.header.stamp.nanosec, 66'666'666U);
  ASSERT_EQ(message.width, 2U);
  EXPECT_EQ(Value(message, 1, 16), 118);
  EXPECT_EQ(Value(message, 1, 24), 1);
  EXPECT_EQ(Point(message, 1)[12], 0x7F);
  EXPECT_EQ(Point(message, 1)[28], 0x7F);
  // Of a recording of a real one.
  Eigen::Matrix3d R_BL;
  R_BL << 0.526114, -0.810136, 0.258620, -0.838668, -0.544643, 0, 0.140854, -0.216897, -0.965979;
  EXPECT_LT((R_BL - robot::FromRollPitchYaw(spec_.rpy)).cwiseAbs().maxCoeff(), 1e-5);
  const Eigen::Vector3d at = R_BL * Eigen::Vector3d(7, 8, 9) + Eigen::Vector3d(0.28216, 0, 0);
  EXPECT_NEAR(Value(message, 1, 0), at.x(), 2e-4);
  EXPECT_NEAR(Value(message, 1, 4), at.y(), 2e-4);
  EXPECT_NEAR(Value(message, 1, 8), at.z(), 2e-4);
}

TEST_F(CloudCodecTest, HasNoPointWhereNothingCameBack) {
  cloud_.points.clear();
  const auto& message = Encoded(Content::kCloud);
  EXPECT_EQ(message.width, 0U);
  EXPECT_EQ(message.data._length, 0U);
}

TEST_F(CloudCodecTest, FillsADeskewedCloudWithPointsAtZero) {
  reading_.deskewed = {{.x = 1.5, .y = 2, .z = 0, .intensity = 99, .time = 0.5}};
  const auto& message = Encoded(Content::kCloudDeskewed);
  EXPECT_STREQ(message.header.frame_id, "odom");
  EXPECT_EQ(message.header.stamp.sec, 13) << "of the last point";
  EXPECT_EQ(message.header.stamp.nanosec, 66'666'666U);
  EXPECT_EQ(message.fields._length, 4U);
  EXPECT_STREQ(message.fields._buffer[3].name, "intensity");
  EXPECT_EQ(message.fields._buffer[3].offset, 16U);
  EXPECT_EQ(message.point_step, 32U);
  ASSERT_EQ(message.width, 10'720U);
  EXPECT_EQ(Value(message, 0, 0), 1.5F);
  EXPECT_EQ(Value(message, 0, 16), 99);
  for (std::size_t i = 1; i < message.width; ++i) {
    for (const std::size_t offset : {0U, 4U, 8U}) ASSERT_EQ(Value(message, i, offset), 0);
  }
}

TEST_F(CloudCodecTest, HasTheLayoutOfALivoxDriverForAMid360) {
  spec_.make = "Mid-360";
  const auto& message = Encoded(Content::kCloud);
  EXPECT_STREQ(message.header.frame_id, "livox_frame");
  EXPECT_EQ(message.point_step, 26U);
  EXPECT_EQ(message.row_step, 3U * 26U);
  std::vector<std::string> fields;
  for (std::uint32_t i = 0; i < message.fields._length; ++i) {
    const auto& field = message.fields._buffer[i];
    fields.push_back(std::string(field.name) + " " + std::to_string(field.offset) + " " +
                     std::to_string(field.datatype));
  }
  EXPECT_THAT(fields, ElementsAre("x 0 7", "y 4 7", "z 8 7", "intensity 12 7", "tag 16 2",
                                  "line 17 2", "timestamp 18 8"));
  EXPECT_EQ(Value(message, 2, 8), 9);
  EXPECT_EQ(Value(message, 2, 12), 118);
  EXPECT_EQ(Point(message, 2)[17], 2);
  double stamp = 0;
  std::memcpy(&stamp, Point(message, 2).data() + 18, sizeof stamp);
  EXPECT_EQ(stamp, 13'066'666'666.0) << "ns";
}

TEST_F(CloudCodecTest, AllocatesNothingAfterTheFirst) {
  for (const Content content : {Content::kCloud, Content::kCloudBase, Content::kCloudDeskewed}) {
    Encoded(content);
    const std::uint64_t before = test::Allocations();
    (*encoder_)(reading_, &message_);
    EXPECT_EQ(test::Allocations(), before);
  }
}

}  // namespace
}  // namespace understudy::wire
