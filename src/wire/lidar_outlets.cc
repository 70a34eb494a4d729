#include "wire/lidar_outlets.h"

#include <algorithm>
#include <utility>

#include "wire/cloud_codec.h"
#include "wire/lidar_codec.h"

namespace understudy::wire {

template <typename Msg, typename Encode>
struct LidarOutlets::TopicOf final : Topic {
  TopicOf(const LidarMessage& message, Encode its_encode, Outlets* outlets)
      : Topic(message.content),
        outlet(outlets->Open<Msg>(message.topic)),
        encode(std::move(its_encode)) {}
  bool IsRead() const override { return outlet->has_readers() && !outlet->drops(); }
  void Send(const robot::LidarReading& reading) override {
    encode(reading, &sent);
    outlet->Send(&sent);
  }

  Outlet<Msg>* outlet;
  Encode encode;
  Msg sent{};
};

template <typename Msg, typename Encode>
void LidarOutlets::Open(const LidarMessage& message, Encode encode, Outlets* outlets) {
  topics_.push_back(std::make_unique<TopicOf<Msg, Encode>>(message, std::move(encode), outlets));
}

LidarOutlets::LidarOutlets(const robot::RobotSpec& spec, Outlets* outlets) {
  const bool mapped = robot::IsMapped(spec.lidar);
  for (const LidarMessage& message : LidarMessages(spec)) {
    switch (message.content) {
      case Content::kImuOfLidar:
        Open<sensor_msgs_msg_dds__Imu_>(message, mapped ? &EncodeLidarImu : &EncodeLivoxImu,
                                        outlets);
        break;
      case Content::kStateOfLidar:
        Open<unitree_go_msg_dds__LidarState_>(message, LidarStateEncoder(spec.lidar), outlets);
        break;
      case Content::kClearance:
        Open<geometry_msgs_msg_dds__PointStamped_>(message, &EncodeClearance, outlets);
        break;
      case Content::kHeightMap:
        Open<unitree_go_msg_dds__HeightMap_>(message, &EncodeHeightMap, outlets);
        break;
      case Content::kMapState:
        Open<unitree_go_msg_dds__VoxelHeightMapState_>(message, &EncodeMapState, outlets);
        break;
      case Content::kVoxelMap:
        Open<unitree_go_msg_dds__VoxelMapCompressed_>(message, VoxelMapEncoder(), outlets);
        break;
      default:
        Open<sensor_msgs_msg_dds__PointCloud2_>(message, CloudEncoder(message.content, spec.lidar),
                                                outlets);
    }
  }
}

bool LidarOutlets::Reads(Content content) const {
  return std::ranges::any_of(topics_, [content](const auto& topic) {
    return topic->content == content && topic->IsRead();
  });
}

void LidarOutlets::Publish(Content content, const robot::LidarReading& reading) {
  for (const auto& topic : topics_) {
    if (topic->content == content) topic->Send(reading);
  }
}

}  // namespace understudy::wire
