// The outlets of a robot's lidar.
#pragma once

#include <memory>
#include <vector>

#include "robot/lidar_reading.h"
#include "robot/robot_spec.h"
#include "wire/outlets.h"
#include "wire/robot_topics.h"

namespace understudy::wire {

// Sends parts of a LidarReading, each on its topic (LidarMessages).
class LidarOutlets {
 public:
  // Throws BusError if Cyclone refuses. `outlets` must outlive it.
  LidarOutlets(const robot::RobotSpec& spec, Outlets* outlets);

  // Returns whether somebody reads that content, and it can arrive.
  bool Reads(Content content) const;
  void Publish(Content content, const robot::LidarReading& reading);

 private:
  struct Topic {
    explicit Topic(Content its_content) : content(its_content) {}
    virtual ~Topic() = default;
    virtual bool IsRead() const = 0;
    virtual void Send(const robot::LidarReading& reading) = 0;

    Content content;
  };
  template <typename Msg, typename Encode>
  struct TopicOf;
  template <typename Msg, typename Encode>
  void Open(const LidarMessage& message, Encode encode, Outlets* outlets);

  std::vector<std::unique_ptr<Topic>> topics_;
};

}  // namespace understudy::wire
