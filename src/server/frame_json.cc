#include "server/frame_json.h"

#include <algorithm>
#include <charconv>
#include <functional>
#include <iterator>
#include <span>

#include <nlohmann/json.hpp>

#include "robot/remote_keys.h"
#include "server/http.h"
#include "server/json_list.h"

namespace understudy::server {
namespace {

using nlohmann::ordered_json;

// A float's precision in its fewest digits: half the text, since frames go out many times a second.
double Short(double number) {
  char digits[32];
  const auto end =
      std::to_chars(std::begin(digits), std::end(digits), static_cast<float>(number)).ptr;
  std::from_chars(digits, end, number);
  return number;
}

ordered_json Numbers(std::span<const double> numbers) { return List(numbers, Short); }

ordered_json Contact(const physics::ContactReading& contact) {
  return {{"at", Numbers(contact.at)},
          {"force", Numbers(contact.force)},
          {"geoms", contact.geoms},
          {"bodies", contact.bodies}};
}

ordered_json Crane(const emulator::FrameCrane& crane) {
  return {{"attached", crane.attached},
          {"hook", Numbers(crane.hook)},
          {"top", Numbers(crane.top)},
          {"tension", Short(crane.tension)}};
}

// No fault of a motor is played, so that there are no errors.
ordered_json Motor(const robot::MotorReading& motor) {
  return {{"q", Short(motor.q)},
          {"dq", Short(motor.dq)},
          {"tau", Short(motor.tau)},
          {"casing", Short(motor.casing_c)},
          {"winding", Short(motor.winding_c)},
          {"mode", motor.enabled ? 1 : 0},
          {"errors", 0},
          {"enabled", motor.enabled}};
}

ordered_json Imu(const robot::ImuReading& imu) {
  const Eigen::Quaterniond& q = imu.R_WI;
  return {{"quaternion", {Short(q.w()), Short(q.x()), Short(q.y()), Short(q.z())}},
          {"gyroscope", Numbers({imu.w_WI_I.data(), 3})},
          {"accelerometer", Numbers({imu.f_WI_I.data(), 3})},
          {"temperature", Short(imu.temperature_c)}};
}

ordered_json Battery(const robot::BatteryReading& battery) {
  return {{"voltage", Short(battery.voltage)},
          {"current", Short(battery.current)},
          {"soc", Short(battery.soc)},
          {"temperature", Short(battery.temperature_c)}};
}

ordered_json Remote(const robot::RemoteReading& remote) {
  return {{"there", remote.there},  {"keys", robot::RemoteKeyNames(remote.keys)},
          {"lx", Short(remote.lx)}, {"ly", Short(remote.ly)},
          {"rx", Short(remote.rx)}, {"ry", Short(remote.ry)}};
}

ordered_json Command(const robot::MotorCommand& command) {
  return {{"q", Short(command.q)},   {"dq", Short(command.dq)},   {"kp", Short(command.kp)},
          {"kd", Short(command.kd)}, {"tau", Short(command.tau)}, {"enabled", command.enabled}};
}

ordered_json Part(const emulator::Frame& frame, emulator::FramePart part) {
  switch (part) {
    case emulator::kPartPositions:
      return frame.positions;
    case emulator::kPartBodies:
      return List(frame.bodies, Numbers);
    case emulator::kPartContacts:
      return List(frame.contacts, Contact);
    case emulator::kPartCom:
      return Numbers(frame.com);
    case emulator::kPartCrane:
      return Crane(frame.crane);
    case emulator::kPartPushes:
      return List(frame.pushes, [&](const emulator::FramePush& push) -> ordered_json {
        return {{"body", frame.body_names[static_cast<std::size_t>(push.body)]},
                {"at", Numbers(push.at)},
                {"force", Numbers(push.force)}};
      });
    case emulator::kPartMotors:
      return List(frame.motors, Motor);
    case emulator::kPartImus:
      return List(std::span(frame.imus).first(frame.imu_count), Imu);
    case emulator::kPartBattery:
      return Battery(frame.battery);
    case emulator::kPartFeet:
      return Numbers(frame.feet);
    case emulator::kPartRemote:
      return Remote(frame.remote);
    case emulator::kPartWirelessRemote:
      return frame.wireless_remote;
    case emulator::kPartCommand:
      return List(frame.command, Command);
  }
  return nullptr;
}

}  // namespace

std::optional<emulator::FrameParts> ReadFrameParts(std::string_view list, std::string* unknown) {
  emulator::FrameParts parts = 0;
  while (!list.empty()) {
    const std::string_view word = list.substr(0, list.find(','));
    list.remove_prefix(std::min(list.size(), word.size() + 1));
    const auto* found =
        std::find_if(std::begin(emulator::kFrameParts), std::end(emulator::kFrameParts),
                     [&](const emulator::FramePartName& part) { return part.name == word; });
    if (found == std::end(emulator::kFrameParts)) {
      *unknown = word;
      return std::nullopt;
    }
    parts |= found->part;
  }
  return parts;
}

std::string FrameJson(const emulator::Frame& frame, emulator::FrameParts parts) {
  ordered_json json{{"step", frame.step},
                    {"time", frame.time},
                    {"speed", Short(frame.speed)},
                    {"paused", frame.paused}};
  for (const emulator::FramePartName& part : emulator::kFrameParts) {
    if ((parts & frame.parts & part.part) != 0)
      json[std::string(part.name)] = Part(frame, part.part);
  }
  return JsonText(json);
}

}  // namespace understudy::server
