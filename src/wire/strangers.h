// Watches for other robots on the network: other writers of rt/lowstate.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bus/discovery.h"
#include "bus/reader.h"
#include "idl/unitree_go.h"
#include "idl/unitree_hg.h"
#include "wire/robot_rank.h"

namespace understudy::wire {

// Watches for other participants with a writer of rt/lowstate. It distinguishes those that publish
// from those that only have a writer, as some C++ clients do (far-unitree-sdk 0.1.8). A participant
// is one stranger, even with several writers. Discovery alone finds them; rt/lowstate is read only
// while there is a stranger, in the type that it writes, so that a robot that is alone has one type
// of the topic in the graph: ROS 2 refuses to echo or record a topic with two.
class StrangerWatch {
 public:
  // Starts watching. `participant` must outlive the watch. Throws BusError if Cyclone refuses.
  explicit StrangerWatch(const bus::Participant& participant);

  // The changes since the last call, in the order of discovery. Each stranger appears once and is
  // reported once when it first publishes, until it has gone.
  struct News {
    std::vector<bus::Neighbour> appeared;
    std::vector<bus::Neighbour> spoke;
  };
  // Never blocks. Does not allocate while there is no stranger. Throws BusError if Cyclone refuses
  // to read what a stranger writes.
  News Poll();

  // As of the last Poll.
  std::vector<bus::Neighbour> silent() const { return WhoseSpeech(false); }
  std::vector<bus::Neighbour> speaking() const { return WhoseSpeech(true); }

  // What a stranger is to us, if our participant announces a robot (wire/robot_rank.h): a robot of
  // this program that began to start earlier or later, or anything else.
  enum class Kind { kOther, kElder, kYounger };
  Kind KindOf(const bus::Neighbour& stranger) const;
  // Returns the robots of this program that began to start before us and have no writer yet, as of
  // the last Poll.
  std::vector<bus::Neighbour> EldersStarting() const;

 private:
  struct Stranger {
    bus::Neighbour who;
    bool speaks = false;
  };

  Kind KindOf(const bus::Announcement& announcement) const;
  std::vector<bus::Neighbour> WhoseSpeech(bool speaks) const;
  // A reader of rt/lowstate in one type, open while a stranger writes that type.
  template <typename Msg>
  struct Ear {
    const bus::Topic<Msg>& topic;
    std::optional<bus::Reader<Msg>> reader{};
  };
  template <typename Msg>
  void Hear(Ear<Msg>* ear, const std::vector<bus::Neighbour>& writers, News* news);

  const bus::Participant& participant_;
  std::optional<RobotRank> ours_;  // nullopt: our participant announces no robot
  bus::NeighbourWatch watch_;
  bus::AnnouncementWatch announcements_;
  std::vector<bus::Announcement> announced_;
  Ear<unitree_go_msg_dds__LowState_> go_;
  Ear<unitree_hg_msg_dds__LowState_> hg_;
  std::vector<Stranger> strangers_;
};

// Returns "A", "A and B" or "A, B and C", each as described by bus::Describe; "" for none.
std::string Describe(const std::vector<bus::Neighbour>& neighbours);

}  // namespace understudy::wire
