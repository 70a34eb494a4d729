#include "viewer/scene_state.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "base/errors.h"

namespace understudy::viewer {
namespace {

using nlohmann::json;

std::vector<SceneState::Force> ReadForces(const json& snapshot, const char* key) {
  std::vector<SceneState::Force> forces;
  for (const json& item : snapshot.value(key, json::array())) {
    forces.push_back({.at = item.at("at").get<Point>(), .force = item.at("force").get<Point>()});
  }
  return forces;
}

std::optional<SceneState::Crane> ReadCrane(const json& snapshot) {
  const json crane = snapshot.value("crane", json());
  if (!crane.is_object() || !crane.value("attached", false)) return std::nullopt;
  return SceneState::Crane{.hook = crane.at("hook").get<Point>(),
                           .top = crane.at("top").get<Point>(),
                           .tension = crane.value("tension", 0.0)};
}

std::string ReadKeys(const json& snapshot) {
  const json remote = snapshot.value("remote", json());
  return remote.is_object() ? remote.value("keys", std::string()) : std::string();
}

}  // namespace

SceneState ReadSnapshot(const std::string& text, std::size_t nq) {
  try {
    const json snapshot = json::parse(text);
    SceneState state;
    state.step = snapshot.at("step").get<std::int64_t>();
    state.time = snapshot.at("time").get<double>();
    state.speed = snapshot.value("speed", 1.0);
    state.paused = snapshot.value("paused", false);
    for (const json& q : snapshot.at("qpos")) {  // null is what is not finite
      state.qpos.push_back(q.is_null() ? std::nan("") : q.get<double>());
    }
    if (state.qpos.size() != nq) {
      throw ControlError("the robot's snapshot has " + std::to_string(state.qpos.size()) +
                         " positions, its model " + std::to_string(nq));
    }
    state.contacts = ReadForces(snapshot, "contacts");
    state.pushes = ReadForces(snapshot, "pushes");
    state.crane = ReadCrane(snapshot);
    state.keys = ReadKeys(snapshot);
    return state;
  } catch (const json::exception& error) {
    throw ControlError(std::string("the robot sent a snapshot that cannot be read: ") +
                       error.what());
  }
}

}  // namespace understudy::viewer
