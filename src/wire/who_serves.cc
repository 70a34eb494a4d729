#include "wire/who_serves.h"

#include <algorithm>
#include <vector>

#include "base/nearest_word.h"
#include "wire/robot_topics.h"

namespace understudy::wire {
namespace {

struct Server {
  std::string_view prefix;
  std::string_view who;
};

// Services of hands are those of unitreerobotics on GitHub.
constexpr Server kServers[] = {
    {"rt/utlidar/", "the lidar of a Go2; what of it is simulated is in docs/seeing.md"},
    {"rt/uslam/", "the mapping of a robot, which is not simulated"},
    {"rt/slam_", "the mapping of a robot, which is not simulated"},
    {"rt/frontvideostream", "the front camera of a Go2"},
    {"rt/front_videohub/", "the front camera of a B2"},
    {"rt/back_videohub/", "the rear camera of a B2"},
    {"rt/dex1/", "a robot with Dex1-1 grippers, as `understudy run g1 --hands dex1`"},
    {"rt/unitree_actuator/",
     "a robot with Dex1-1 grippers of old programs, as `understudy run g1 --hands dex1_old`"},
    {"rt/hand_sdk",
     "the motion service of a G1 with Dex1-1 grippers, as `understudy run g1 --hands dex1`"},
    {"rt/dex3/", "a robot with Dex3-1 hands, as `understudy run g1 --hands dex3`"},
    {"rt/inspire/", "a robot with Inspire DFX hands, as `understudy run g1 --hands inspire`"},
    {"rt/inspire_hand/",
     "a robot with Inspire FTP hands, as `understudy run g1 --hands inspire_ftp`"},
    {"rt/brainco/", "a robot with Revo2 hands, as `understudy run g1 --hands brainco`"},
    {"rt/api/", "a service that this robot does not have, or whose program is off"},
};

}  // namespace

std::string WhoServes(std::string_view topic) {
  for (const Server& one : kServers) {
    if (topic.starts_with(one.prefix)) return std::string(one.who);
  }
  return TypesOf(topic).empty() ? "" : "a robot of another kind";
}

std::string WhoWouldSend(std::string_view topic) {
  std::string who = WhoServes(topic);
  if (!who.empty()) return who;
  if (const std::string full = "rt/" + std::string(topic); !TypesOf(full).empty()) {
    return "a robot, whose topic has the name " + full + " on DDS";
  }
  std::vector<std::string> known;
  for (const TopicName& one : VendorTopics()) known.emplace_back(one.name);
  return "nobody that is known; no robot of the vendor's has that topic" +
         NearestHint(topic, known);
}

}  // namespace understudy::wire
