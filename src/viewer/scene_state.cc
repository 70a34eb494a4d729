#include "viewer/scene_state.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "base/errors.h"

namespace understudy::viewer {
namespace {

using nlohmann::json;

std::vector<SceneState::Force> ReadForces(const json& frame, const char* key) {
  std::vector<SceneState::Force> forces;
  for (const json& item : frame.value(key, json::array())) {
    forces.push_back({.at = item.at("at").get<Point>(), .force = item.at("force").get<Point>()});
  }
  return forces;
}

std::optional<SceneState::Crane> ReadCrane(const json& frame) {
  const json crane = frame.value("crane", json());
  if (!crane.is_object() || !crane.value("attached", false)) return std::nullopt;
  return SceneState::Crane{.hook = crane.at("hook").get<Point>(),
                           .top = crane.at("top").get<Point>(),
                           .tension = crane.value("tension", 0.0)};
}

std::string ReadKeys(const json& frame) {
  const json remote = frame.value("remote", json());
  return remote.is_object() ? remote.value("keys", std::string()) : std::string();
}

}  // namespace

SceneState ReadFrame(const std::string& text, std::size_t nq) {
  try {
    const json frame = json::parse(text);
    SceneState state;
    state.step = frame.at("step").get<std::int64_t>();
    state.time = frame.at("time").get<double>();
    state.speed = frame.value("speed", 1.0);
    state.paused = frame.value("paused", false);
    for (const json& q : frame.at("qpos")) {  // null is what is not finite
      state.qpos.push_back(q.is_null() ? std::nan("") : q.get<double>());
    }
    if (state.qpos.size() != nq) {
      throw ControlError("the robot's frame has " + std::to_string(state.qpos.size()) +
                         " positions, its model " + std::to_string(nq));
    }
    state.contacts = ReadForces(frame, "contacts");
    state.pushes = ReadForces(frame, "pushes");
    state.crane = ReadCrane(frame);
    state.keys = ReadKeys(frame);
    return state;
  } catch (const json::exception& error) {
    throw ControlError(std::string("the robot sent a frame that cannot be read: ") + error.what());
  }
}

}  // namespace understudy::viewer
