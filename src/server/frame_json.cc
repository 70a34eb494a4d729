// Written without a document in between: it is made many times a second.
#include "server/frame_json.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <type_traits>

#include <nlohmann/json.hpp>

#include "robot/remote_keys.h"

namespace understudy::server {
namespace {

template <class Number>
void Put(Number number, std::string* text) {
  if constexpr (std::is_floating_point_v<Number>) {
    if (!std::isfinite(number)) {
      *text += "null";
      return;
    }
  }
  char digits[32];
  const auto end = std::to_chars(std::begin(digits), std::end(digits), number).ptr;
  text->append(digits, end);
}

// Objects and arrays, whose commas it knows.
class Writer {
 public:
  explicit Writer(std::string* text) : text_(text) {}

  Writer& Key(std::string_view name) {
    Separate();
    *text_ += '"';
    *text_ += name;  // ours, nothing to escape
    *text_ += "\":";
    fresh_ = true;
    return *this;
  }
  Writer& Begin(char bracket) {
    Separate();
    *text_ += bracket;
    fresh_ = true;
    return *this;
  }
  Writer& End(char bracket) {
    *text_ += bracket;
    fresh_ = false;
    return *this;
  }
  Writer& Exact(double number) {
    Separate();
    Put(number, text_);
    return *this;
  }
  Writer& Number(double number) {
    Separate();
    Put(static_cast<float>(number), text_);
    return *this;
  }
  Writer& Integer(std::int64_t number) {
    Separate();
    Put(number, text_);
    return *this;
  }
  Writer& Bool(bool value) {
    Separate();
    *text_ += value ? "true" : "false";
    return *this;
  }
  Writer& Text(std::string_view value) {
    Separate();
    using nlohmann::json;
    *text_ += json(value).dump(-1, ' ', false, json::error_handler_t::replace);
    return *this;
  }
  Writer& Numbers(std::span<const double> numbers) {
    Begin('[');
    for (const double number : numbers) Number(number);
    return End(']');
  }

 private:
  void Separate() {
    if (!fresh_) *text_ += ',';
    fresh_ = false;
  }

  std::string* text_;
  bool fresh_ = true;
};

void PutContact(const physics::ContactReading& contact, Writer* to) {
  to->Begin('{').Key("at").Numbers(contact.at).Key("force").Numbers(contact.force);
  const auto put = [&](std::string_view name, const std::array<int, 2>& ids) {
    to->Key(name).Begin('[').Integer(ids[0]).Integer(ids[1]).End(']');
  };
  put("geoms", contact.geoms);
  put("bodies", contact.bodies);
  to->End('}');
}

void PutCrane(const emulator::FrameCrane& crane, Writer* to) {
  to->Begin('{').Key("attached").Bool(crane.attached).Key("hook").Numbers(crane.hook);
  to->Key("top").Numbers(crane.top).Key("tension").Number(crane.tension).End('}');
}

void PutPush(const emulator::Frame& frame, const emulator::FramePush& push, Writer* to) {
  to->Begin('{').Key("body").Text(frame.body_names[static_cast<std::size_t>(push.body)]);
  to->Key("at").Numbers(push.at);
  to->Key("force").Numbers(push.force).End('}');
}

// No fault of a motor is played, so that there are no errors.
void PutMotor(const robot::MotorReading& motor, Writer* to) {
  to->Begin('{').Key("q").Number(motor.q).Key("dq").Number(motor.dq).Key("tau").Number(motor.tau);
  to->Key("casing").Number(motor.casing_c).Key("winding").Number(motor.winding_c);
  to->Key("mode").Integer(motor.enabled ? 1 : 0).Key("errors").Integer(0);
  to->Key("enabled").Bool(motor.enabled).End('}');
}

void PutImu(const robot::ImuReading& imu, Writer* to) {
  const Eigen::Quaterniond& q = imu.R_WI;
  const double quaternion[] = {q.w(), q.x(), q.y(), q.z()};
  to->Begin('{').Key("quaternion").Numbers(quaternion);
  to->Key("gyroscope").Numbers({imu.w_WI_I.data(), 3});
  to->Key("accelerometer").Numbers({imu.f_WI_I.data(), 3});
  to->Key("temperature").Number(imu.temperature_c).End('}');
}

void PutBattery(const robot::BatteryReading& battery, Writer* to) {
  to->Begin('{').Key("voltage").Number(battery.voltage).Key("current").Number(battery.current);
  to->Key("soc").Number(battery.soc).Key("temperature").Number(battery.temperature_c).End('}');
}

void PutRemote(const robot::RemoteReading& remote, Writer* to) {
  to->Begin('{')
      .Key("there")
      .Bool(remote.there)
      .Key("keys")
      .Text(robot::RemoteKeyNames(remote.keys));
  to->Key("lx").Number(remote.lx).Key("ly").Number(remote.ly);
  to->Key("rx").Number(remote.rx).Key("ry").Number(remote.ry).End('}');
}

void PutCommand(const robot::MotorCommand& command, Writer* to) {
  to->Begin('{').Key("q").Number(command.q).Key("dq").Number(command.dq);
  to->Key("kp").Number(command.kp).Key("kd").Number(command.kd).Key("tau").Number(command.tau);
  to->Key("enabled").Bool(command.enabled).End('}');
}

template <class Values, class PutOne>
void PutAll(const Values& values, PutOne put, Writer* to) {
  to->Begin('[');
  for (const auto& value : values) put(value, to);
  to->End(']');
}

void PutPart(const emulator::Frame& frame, emulator::FramePart part, Writer* to) {
  switch (part) {
    case emulator::kPartPositions:
      return PutAll(
          frame.positions, [](double q, Writer* w) { w->Exact(q); }, to);
    case emulator::kPartBodies:
      return PutAll(
          frame.bodies, [](const physics::BodyPose& pose, Writer* w) { w->Numbers(pose); }, to);
    case emulator::kPartContacts:
      return PutAll(frame.contacts, PutContact, to);
    case emulator::kPartCom:
      to->Numbers(frame.com);
      return;
    case emulator::kPartCrane:
      return PutCrane(frame.crane, to);
    case emulator::kPartPushes:
      return PutAll(
          frame.pushes,
          [&](const emulator::FramePush& push, Writer* w) { PutPush(frame, push, w); }, to);
    case emulator::kPartMotors:
      return PutAll(frame.motors, PutMotor, to);
    case emulator::kPartImus:
      return PutAll(std::span(frame.imus).first(frame.imu_count), PutImu, to);
    case emulator::kPartBattery:
      return PutBattery(frame.battery, to);
    case emulator::kPartFeet:
      to->Numbers(frame.feet);
      return;
    case emulator::kPartRemote:
      return PutRemote(frame.remote, to);
    case emulator::kPartWirelessRemote:
      return PutAll(
          frame.wireless_remote, [](std::uint8_t b, Writer* w) { w->Integer(b); }, to);
    case emulator::kPartCommand:
      return PutAll(frame.command, PutCommand, to);
  }
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
  std::string text;
  text.reserve(8192);
  Writer writer(&text);
  writer.Begin('{').Key("step").Integer(frame.step).Key("time").Exact(frame.time);
  writer.Key("speed").Number(frame.speed).Key("paused").Bool(frame.paused);
  for (const emulator::FramePartName& part : emulator::kFrameParts) {
    if ((parts & frame.parts & part.part) == 0) continue;
    PutPart(frame, part.part, &writer.Key(part.name));
  }
  writer.End('}');
  return text;
}

}  // namespace understudy::server
