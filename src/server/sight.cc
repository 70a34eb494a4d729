#include "server/sight.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "idl/type_table.h"
#include "record/lidar_messages.h"
#include "robot/rotations.h"

namespace understudy::server {
namespace {

using Points = std::vector<Eigen::Vector3f>;

Points Moved(Points points, const Eigen::Isometry3d& by) {
  const Eigen::Isometry3f T = by.cast<float>();
  for (Eigen::Vector3f& point : points) point = T * point;
  return points;
}

// The lidar's frame in that of the body that carries it.
Eigen::Isometry3d MountOf(const robot::LidarSpec& spec) {
  return Eigen::Translation3d(spec.pos) * Eigen::Quaterniond(robot::FromRollPitchYaw(spec.rpy));
}

std::string BytesOf(const Points& points) {
  return {reinterpret_cast<const char*>(points.data()), points.size() * sizeof(Points::value_type)};
}

}  // namespace

Sight::Sight(const bus::Participant* participant, const robot::RobotSpec& spec)
    : participant_(participant), make_(spec.lidar.make) {
  if (participant_ == nullptr || !robot::HasLidar(spec.lidar)) return;
  const bool mapped = robot::IsMapped(spec.lidar);
  Add({.name = "cloud",
       .body = spec.lidar.body.empty() ? spec.base_body : spec.lidar.body,
       .points =
           [mount = MountOf(spec.lidar)](const std::vector<Topic>& topics) {
             return Moved(record::ReadPointCloud(topics[0].newest->bytes()), mount);
           }},
      {mapped ? wire::topic::kLidarCloud : wire::topic::kLivoxCloud});
  if (!mapped) return;
  Add({.name = "heights",
       .body = spec.base_body,
       .points =
           [](const std::vector<Topic>& topics) {
             return Moved(record::ReadHeightMap(topics[0].newest->bytes()),
                          record::ReadPose(topics[1].newest->bytes()).inverse());
           }},
      {wire::topic::kLidarHeights, wire::topic::kLidarPose});
}

void Sight::Add(View view, std::initializer_list<wire::TopicName> topics) {
  for (const wire::TopicName& name : topics) {
    view.topics.push_back({.name = name, .reader = nullptr, .newest = std::nullopt});
  }
  views_.push_back(std::move(view));
}

HttpReply Sight::List() const {
  nlohmann::ordered_json views = nlohmann::ordered_json::array();
  for (const View& view : views_) views.push_back({{"name", view.name}, {"body", view.body}});
  return {.body = JsonText({{"make", make_}, {"views", views}}) + "\n"};
}

HttpReply Sight::Get(std::string_view name, Clock::time_point now) {
  std::vector<std::string> names;
  for (View& view : views_) {
    names.push_back(view.name);
    if (view.name != name) continue;
    view.asked = now;
    bool complete = true;
    for (Topic& topic : view.topics) {
      if (topic.reader == nullptr) {
        topic.reader =
            std::make_unique<bus::CdrReader>(*participant_, std::string(topic.name.name),
                                             *FindMessageType(topic.name.type)->descriptor);
      }
      topic.reader->Take([&](bus::CdrSample sample) { topic.newest.emplace(std::move(sample)); });
      complete = complete && topic.newest;
    }
    try {
      return {.body = BytesOf(complete ? view.points(view.topics) : Points()),
              .type = "application/octet-stream"};
    } catch (const RecordError& error) {
      return ErrorReply(500, view.name + ": " + error.what());
    }
  }
  const std::string shown{name.substr(0, 64)};
  return ErrorReply(404, names.empty() ? "this robot has no lidar"
                                       : "a lidar shows no " + shown + DidYouMean(shown, names));
}

void Sight::Rest(Clock::time_point now) {
  for (View& view : views_) {
    if (now - view.asked < kLapse) continue;
    for (Topic& topic : view.topics) {
      topic.reader.reset();
      topic.newest.reset();
    }
  }
}

bool Sight::reads() const {
  for (const View& view : views_) {
    if (view.topics.front().reader != nullptr) return true;
  }
  return false;
}

}  // namespace understudy::server
