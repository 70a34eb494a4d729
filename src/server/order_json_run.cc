// Orders about the run itself.
#include <cmath>

#include "base/nearest_word.h"
#include "server/json_body.h"
#include "server/order_json.h"

namespace understudy::server {
namespace {

using nlohmann::json;

// What `object` has under `key`, null where it has nothing. Not a copy: copying recurses, and a
// client chooses how deep.
const json& At(const json& object, const char* key) {
  static const json kNull;
  const auto found = object.find(key);
  return found == object.end() ? kNull : *found;
}

}  // namespace

OrderReading ReadPauseOrder(std::string_view body) {
  const auto read = ReadObject(body, {"on"});
  if (const auto* why = std::get_if<std::string>(&read)) return *why;
  const json& on = At(std::get<json>(read), "on");
  if (!on.is_boolean()) return Expected("on", "true or false", on);
  return emulator::Order{emulator::PauseRun{on.get<bool>()}};
}

OrderReading ReadStepOrder(std::string_view body) {
  const auto read = ReadObject(body, {"steps"});
  if (const auto* why = std::get_if<std::string>(&read)) return *why;
  const json& object = std::get<json>(read);
  const auto steps = object.find("steps");
  if (steps == object.end()) return emulator::Order{emulator::StepRun{}};
  const double number = NumberWithin(*steps, static_cast<double>(kMostSteps));
  if (!(number >= 1) || number != std::floor(number)) {
    return Expected("steps", "a whole number from 1 to " + std::to_string(kMostSteps), *steps);
  }
  return emulator::Order{emulator::StepRun{static_cast<std::int64_t>(number)}};
}

OrderReading ReadSpeedOrder(std::string_view body) {
  const auto read = ReadObject(body, {"speed"});
  if (const auto* why = std::get_if<std::string>(&read)) return *why;
  const json& speed = At(std::get<json>(read), "speed");
  const double number = NumberWithin(speed, time::kMostSpeed);
  if (!time::IsSpeed(number)) return Expected("speed", time::kSpeedRange, speed);
  return emulator::Order{emulator::SetSpeed{number}};
}

OrderReading ReadResetOrder(std::string_view body) {
  if (body.empty()) return emulator::Order{emulator::ResetRobot{}};
  const auto read = ReadObject(body, {"pose"});
  if (const auto* why = std::get_if<std::string>(&read)) return *why;
  const json& object = std::get<json>(read);
  const auto pose = object.find("pose");
  if (pose == object.end()) return emulator::Order{emulator::ResetRobot{}};
  const std::vector<std::string> words(robot::kStartPoses.begin(), robot::kStartPoses.end());
  if (!pose->is_string()) return Expected("pose", "one of " + Listed(words), *pose);
  const auto& word = pose->get_ref<const std::string&>();
  const auto found = robot::FindStartPose(word);
  if (!found) return "\"pose\": no pose " + Shown(*pose) + DidYouMean(word, words);
  return emulator::Order{emulator::ResetRobot{.pose = found}};
}

}  // namespace understudy::server
