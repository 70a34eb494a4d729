#include "services/robot_services.h"

#include <algorithm>
#include <array>

#include "services/tables/tables.h"

namespace understudy::services {
namespace {

// Velocities: [docs] Go2 motion services V2.0; Go2-W high-level motion services, default gait.
constexpr MoveLimits kGo2Move{
    .vx_min = -2.5, .vx_max = 3.8, .vy = 1.0, .yaw_rate = 4.0, .hold = 1.0};
constexpr MoveLimits kGo2wMove{
    .vx_min = -1.5, .vx_max = 1.5, .vy = 0.6, .yaw_rate = 1.0, .hold = 1.0};
constexpr MoveLimits B2Move(double hold) {
  return {.vx_min = -kUnlimited,
          .vx_max = kUnlimited,
          .vy = kUnlimited,
          .yaw_rate = kUnlimited,
          .hold = hold};
}

struct Binding {
  std::string_view robot;
  std::vector<ServiceTable> (*tables)();
};

std::vector<ServiceTable> Go2Tables() {
  return {RobotStateTable(),
          Go2SportTable("sport of Go2", kGo2Move),
          ObstaclesAvoidTable(),
          VuiTable(),
          VideoTable("videohub", "videohub of Go2, Go2-W", "1.0.0.1"),
          UwbSwitchTable()};
}

// avoidance, vui and videohub of a Go2-W: assumed, as it is programmed with the Go2's clients.
std::vector<ServiceTable> Go2wTables() {
  return {RobotStateTable(), Go2SportTable("sport of Go2-W", kGo2wMove), ObstaclesAvoidTable(),
          VuiTable(), VideoTable("videohub", "videohub of Go2, Go2-W", "1.0.0.1")};
}

std::vector<ServiceTable> B2LikeTables(ServiceTable sport) {
  return {RobotStateLongTable(), std::move(sport), VuiTable(),
          VideoTable("front_videohub", "front_videohub of B2, B2-W", "1.0.0.0"),
          VideoTable("back_videohub", "back_videohub of B2, B2-W", "1.0.0.0")};
}

std::vector<ServiceTable> B2Tables() {
  return B2LikeTables(B2SportTable("sport of B2", B2Move(1.0)));
}
std::vector<ServiceTable> B2wTables() {
  return B2LikeTables(B2SportTable("sport of B2-W", B2Move(0.5)));
}
std::vector<ServiceTable> A2Tables() {
  return {RobotStateLongTable(), A2SportTable(), VoiceTable()};
}
std::vector<ServiceTable> As2Tables() { return {RobotStateLongTable(), As2SportTable()}; }
std::vector<ServiceTable> G1Tables() {
  return {RobotStateLongTable(), G1SportTable(), G1ArmTable(), VoiceTable()};
}
std::vector<ServiceTable> G1dTables() {
  return {RobotStateLongTable(), G1ArmTable(), VoiceTable(), G1AgvTable()};
}
std::vector<ServiceTable> R1Tables() {
  return {RobotStateLongTable(), R1SportTable(), VoiceTable()};
}
std::vector<ServiceTable> H2Tables() { return {RobotStateLongTable(), H2SportTable()}; }
std::vector<ServiceTable> H1Tables() { return {RobotStateLongTable(), H1LocoTable()}; }

constexpr std::array kBindings = {
    Binding{"go2", &Go2Tables}, Binding{"go2w", &Go2wTables}, Binding{"b2", &B2Tables},
    Binding{"b2w", &B2wTables}, Binding{"a2", &A2Tables},     Binding{"as2", &As2Tables},
    Binding{"g1", &G1Tables},   Binding{"g1d", &G1dTables},   Binding{"h1", &H1Tables},
    Binding{"h1_2", &H1Tables}, Binding{"h2", &H2Tables},     Binding{"r1", &R1Tables}};

// The robot itself, or the one with the longest name of which it is a build.
const Binding* Find(std::string_view robot) {
  const Binding* found = nullptr;
  for (const Binding& binding : kBindings) {
    const bool is_build = robot.size() > binding.robot.size() && robot.starts_with(binding.robot) &&
                          robot[binding.robot.size()] == '_';
    if (robot != binding.robot && !is_build) continue;
    if (found == nullptr || binding.robot.size() > found->robot.size()) found = &binding;
  }
  return found;
}

}  // namespace

std::vector<std::string_view> RobotsWithServices() {
  std::vector<std::string_view> robots;
  for (const Binding& binding : kBindings) robots.push_back(binding.robot);
  return robots;
}

std::vector<ServiceTable> ServicesOf(std::string_view robot) {
  std::vector<ServiceTable> tables = {MotionSwitcherTable(), ConfigTable()};
  const Binding* binding = Find(robot);
  if (binding == nullptr) {
    tables.push_back(RobotStateLongTable());
    return tables;
  }
  std::ranges::move(binding->tables(), std::back_inserter(tables));
  return tables;
}

}  // namespace understudy::services
