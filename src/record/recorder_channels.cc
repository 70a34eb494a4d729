// What the recorder writes: the head of its file, and each message on its channel.
#include <nlohmann/json.hpp>

#include "record/recorder.h"
#include "record/ros2msg.h"

namespace understudy::record {
namespace {

// RELIABLE, KEEP_LAST and either TRANSIENT_LOCAL or VOLATILE in the notation of rosbag2.
std::string Qos(int depth, bool latched) {
  return "- history: 1\n  depth: " + std::to_string(depth) +
         "\n  reliability: 1\n  durability: " + (latched ? "1" : "2") +
         "\n"
         "  deadline:\n    sec: 9223372036\n    nsec: 854775807\n"
         "  lifespan:\n    sec: 9223372036\n    nsec: 854775807\n"
         "  liveliness: 1\n"
         "  liveliness_lease_duration:\n    sec: 9223372036\n    nsec: 854775807\n"
         "  avoid_ros_namespace_conventions: false";
}

// As ROS's own broadcaster of transforms has it (tf2_ros).
constexpr int kRosDepth = 100;

}  // namespace

void Recorder::Begin(const RecordingHead& head) {
  StringMap about = head.about;
  about["start_time_ns"] = std::to_string(start_);
  about["timestep_ns"] = std::to_string(timestep_);
  writer_.AddMetadata("understudy", about);
  writer_.Attach("config.yaml", "application/yaml", start_, AsBytes(head.config));
  writer_.Attach("model.mjb", "application/octet-stream", start_, AsBytes(head.model));
  if (audience_ != nullptr) audience_->Begin(start_);
  const auto channel = [&](const char* topic, const char* type, const char* text,
                           StringMap metadata = {}) {
    metadata.merge(StringMap{{"from", "simulation"}, {"offered_qos_profiles", Qos(1, false)}});
    return AddChannel(topic, type, writer_.AddSchema(type, "ros2msg", text), metadata);
  };
  StringMap addresses = head.base.metadata();
  AddObjects(head.objects, &addresses);
  truth_channel_ = channel(kTruthTopic, kTruthType, kTruthText, addresses);
  event_channel_ = channel(kEventTopic, kEventType, kEventText);
  damage_channel_ = channel(kDamageTopic, kDamageType, kDamageText);
  if (ros_) BeginRos();
  writer_.Flush();
  bytes_ = writer_.bytes();
}

// What does not change is written once, at the time of the first step.
void Recorder::BeginRos() {
  const auto channel = [&](const RosTopic& topic) {
    const auto [schema, is_new] = schemas_.try_emplace(topic.type, 0);
    if (is_new) schema->second = writer_.AddSchema(topic.type, "ros2msg", RosSchema(topic));
    return AddChannel(
        topic.name, topic.type, schema->second,
        {{"from", "simulation"},
         {"offered_qos_profiles", Qos(topic.latched ? 1 : kRosDepth, topic.latched)}});
  };
  const std::uint64_t first = LogTime(marked_ + 1);
  EncodeRobotDescription(*ros_, &message_);
  Write(channel(kRobotDescriptionTopic), first, first, message_.span());
  EncodeScene(*ros_, first, &message_);
  Write(channel(kSceneTopic), first, first, message_.span());
  EncodeTfStatic(*ros_, first, &message_);
  Write(channel(kTfStaticTopic), first, first, message_.span());
  tf_channel_ = channel(kTfTopic);
  joint_states_channel_ = channel(kJointStatesTopic);
  clock_channel_ = channel(kClockTopic);
  ros_->urdf = {};  // which may be some MB
  ros_->scene = {};
}

void Recorder::WriteTruth(const Truth& truth) {
  EncodeTruth(truth, &message_);
  const std::uint64_t time = LogTime(truth.step);
  Write(truth_channel_, time, time, message_.span());
  if (!ros_ || truth.step % ros_->every != 0) return;
  EncodeClock(time, &message_);
  Write(clock_channel_, time, time, message_.span());
  EncodeTf(*ros_, truth, time, &message_);
  Write(tf_channel_, time, time, message_.span());
  EncodeJointStates(*ros_, truth, time, &message_);
  Write(joint_states_channel_, time, time, message_.span());
}

void Recorder::WriteEvent(const emulator::ToldEvent& told) {
  using nlohmann::json;
  const RecordedEvent event{
      .step = told.event.step,
      .time = told.event.time,
      .kind = std::string(told.kind()),
      .text = told.text(),
      .detail = told.detail().dump(-1, ' ', false, json::error_handler_t::replace)};
  EncodeEvent(event, &message_);
  Write(event_channel_, LogTime(event.step), LogTime(event.step), message_.span());
}

void Recorder::WriteSample(const Waiting& waiting, std::int64_t step) {
  Write(ChannelOf(&topics_[waiting.topic], waiting.ours), LogTime(step),
        static_cast<std::uint64_t>(waiting.sample.source_time()), waiting.sample.bytes());
}

std::uint16_t Recorder::AddChannel(const std::string& topic, const std::string& type,
                                   std::uint16_t schema, const StringMap& metadata) {
  const std::uint16_t id = writer_.AddChannel(topic, schema, "cdr", metadata);
  if (audience_ != nullptr) {
    told_channels_[id] = {.channel = {.id = id,
                                      .schema_id = schema,
                                      .topic = topic,
                                      .encoding = "cdr",
                                      .metadata = metadata},
                          .type = type};
  }
  return id;
}

void Recorder::Write(std::uint16_t channel, std::uint64_t log_time, std::uint64_t publish_time,
                     ByteSpan data) {
  writer_.Write(channel, log_time, publish_time, data);
  if (audience_ == nullptr) return;
  const Told& told = told_channels_.at(channel);
  audience_->Hear(
      told.channel, told.type,
      {.channel_id = channel, .log_time = log_time, .publish_time = publish_time, .data = data});
}

std::uint16_t Recorder::ChannelOf(Topic* topic, bool ours) {
  std::optional<std::uint16_t>& channel = topic->channels[ours ? 1 : 0];
  if (channel) return *channel;
  const std::string type = RosTypeName(topic->name.type);
  auto schema = schemas_.find(type);
  if (schema == schemas_.end()) {
    const std::uint16_t id = writer_.AddSchema(type, "ros2msg", Ros2MsgText(type));
    schema = schemas_.emplace(type, id).first;
  }
  channel = AddChannel(RosTopicName(topic->name.topic), type, schema->second,
                       {{"from", ours ? "robot" : "client"},
                        {"dds_topic", topic->name.topic},
                        {"dds_type", topic->name.type},
                        {"offered_qos_profiles", Qos(1, false)}});
  return *channel;
}

}  // namespace understudy::record
