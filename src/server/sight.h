// Shows what a robot's lidar sees, for pages that draw it.
#pragma once

#include <chrono>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include "bus/cdr.h"
#include "bus/participant.h"
#include "robot/robot_spec.h"
#include "server/http.h"
#include "wire/robot_topics.h"

namespace understudy::server {

// Reads the robot's own topics as a program would, while somebody asks: nothing is cast for nobody.
// For the server's thread.
class Sight {
 public:
  using Clock = std::chrono::steady_clock;

  static constexpr std::chrono::seconds kLapse{3};  // from the last question on; *assumed*

  // There is nothing to see.
  Sight() = default;
  // `participant` must outlive it. `spec` names bodies as GET /scene does.
  Sight(const bus::Participant* participant, const robot::RobotSpec& spec);

  // {"make": "L1", "views": [{"name": "cloud", "body": "base_link"}, ...]}
  HttpReply List() const;
  // Returns the points of a view as float32 x, y, z [m] in the frame of its body, none until the
  // first have come; 404 for an unknown view.
  HttpReply Get(std::string_view name, Clock::time_point now = Clock::now());
  // Reads no more what nobody has asked for.
  void Rest(Clock::time_point now = Clock::now());

  bool reads() const;

 private:
  // A topic and its newest message.
  struct Topic {
    wire::TopicName name;
    std::unique_ptr<bus::CdrReader> reader;
    std::optional<bus::CdrSample> newest;
  };
  using Points = std::vector<Eigen::Vector3f>;
  // Makes points of the newest messages, one of each topic.
  using MakePoints = std::function<Points(const std::vector<Topic>&)>;
  struct View {
    std::string name;
    std::string body;
    MakePoints points;
    std::vector<Topic> topics{};
    Clock::time_point asked{};
  };

  void Add(View view, std::initializer_list<wire::TopicName> topics);

  const bus::Participant* participant_ = nullptr;
  std::string make_ = "none";
  std::vector<View> views_;
};

}  // namespace understudy::server
