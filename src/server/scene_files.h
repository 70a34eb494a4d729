// Makes the replies to GET /scene and its sub-paths.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "physics/scene_reader.h"
#include "robot/robot_spec.h"
#include "server/http.h"

namespace understudy::server {

// Makes a body once and shares it among the replies that are being sent. For one thread.
class SceneFiles {
 public:
  // Of a robot, whose names have that prefix in the scene. Both must outlive it.
  SceneFiles(physics::SceneReader* reader, const robot::RobotSpec* robot, std::string prefix = "")
      : reader_(reader), robot_(robot), prefix_(std::move(prefix)) {}

  HttpReply Scene();
  // `index` is the text of the path.
  HttpReply Mesh(std::string_view index);
  HttpReply HeightField(std::string_view index);
  HttpReply Model();

 private:
  using Content = std::shared_ptr<const std::string>;

  Content Make(const std::string& name, const std::function<std::string()>& make);
  HttpReply Part(const std::string& what, std::string_view index, int count,
                 std::string (physics::SceneReader::*make)(int));
  std::string SceneText();

  physics::SceneReader* reader_;
  const robot::RobotSpec* robot_;
  std::string prefix_;
  std::map<std::string, std::weak_ptr<const std::string>> made_;
};

}  // namespace understudy::server
