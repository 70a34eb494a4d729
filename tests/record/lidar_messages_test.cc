#include "record/lidar_messages.h"

#include <cmath>
#include <limits>
#include <string>

#include <gmock/gmock.h>

#include "base/errors.h"
#include "tests/support/lidar_messages.h"

namespace understudy::record {
namespace {

using test::CloudMessage;
using test::HeightMapMessage;
using test::PoseMessage;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using Vec = Eigen::Vector3f;
template <class F>
std::string WhyNot(const F& read) {
  try {
    read();
  } catch (const RecordError& error) {
    return error.what();
  }
  return "";
}

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(PointCloudTest, HasThePointsThatAreEchoes) {
  const auto message = CloudMessage({.points = {{1, 2, 3}, {0, 0, 0}, {kNan, 1, 1}, {4, 5, 6}}});
  EXPECT_THAT(ReadPointCloud(message.span()), ElementsAre(Vec(1, 2, 3), Vec(4, 5, 6)));
  EXPECT_THAT(ReadPointCloud(CloudMessage({}).span()), IsEmpty());
}

TEST(PointCloudTest, IsRefusedWhereItsBytesAreNoCloud) {
  const auto why = [](const test::MadeCloud& cloud) {
    return WhyNot([&] { ReadPointCloud(CloudMessage(cloud).span()); });
  };
  EXPECT_THAT(why({.points = {{1, 2, 3}}, .type = 8}), HasSubstr("whose x has type 8"));
  EXPECT_THAT(why({.points = {{1, 2, 3}}, .point_step = 15}), HasSubstr("points are missing"));
  EXPECT_THAT(why({.points = {{1, 2, 3}, {4, 5, 6}}, .missing = 1}),
              HasSubstr("points are missing"));
  BytesOut big = CloudMessage({});
  const std::string text(reinterpret_cast<const char*>(big.span().data()), big.size());
  std::string other = text;
  other[1] = 0;
  EXPECT_THROW(ReadPointCloud(AsBytes(other)), RecordError);
  for (std::size_t size = 0; size + 1 < text.size(); ++size) {  // all but whether it is dense
    EXPECT_THROW(ReadPointCloud(AsBytes(text.substr(0, size))), RecordError) << size;
  }
}

TEST(HeightMapTest, HasTheCellsThatWereSeen) {
  const auto message = HeightMapMessage(2, 2, {0.1F, 1e9F, 0.3F, kNan});
  EXPECT_THAT(ReadHeightMap(message.span()), ElementsAre(Vec(1, 2, 0.1F), Vec(1, 2.5, 0.3F)));
}

TEST(HeightMapTest, IsRefusedWithMoreOrFewerHeightsThanCells) {
  EXPECT_THAT(WhyNot([] {
                ReadHeightMap(HeightMapMessage(2, 2, {1, 2, 3}).span());
              }),
              HasSubstr("a map of 2 by 2 cells with 3 heights"));
}

TEST(PoseTest, IsThatOfTheMessage) {
  const double half = std::sqrt(0.5);
  const Eigen::Isometry3d T = ReadPose(PoseMessage({1, 2, 3, 0, 0, half, half}).span());
  EXPECT_TRUE((T * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(1, 3, 3)));
}

TEST(PoseTest, IsRefusedWithoutARotation) {
  EXPECT_THROW(ReadPose(PoseMessage({1, 2, 3, 0, 0, 0, 0}).span()), RecordError);
}

}  // namespace
}  // namespace understudy::record
