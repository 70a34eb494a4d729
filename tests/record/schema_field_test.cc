#include "record/schema_field.h"

#include <string>

#include <gmock/gmock.h>

#include "record/cdr_field.h"
#include "record/cdr_out.h"
#include "record/ros2msg.h"
#include "record/ros_topics.h"
#include "record/truth.h"

namespace understudy::record {
namespace {

// What a byte is, and its value.
std::string What(std::string_view schema, const BytesOut& message, std::size_t at) {
  const auto found = FieldWithByte(schema, message.span(), at);
  return found ? found->path + " = " + ValueText(*found, message.span()) : "";
}

BytesOut EventMessage() {
  BytesOut message;
  EncodeEvent({.step = 7, .time = 0.014, .kind = "program_end", .text = "it ended", .detail = "{}"},
              &message);
  return message;
}

TEST(SchemaFieldTest, NamesTheNumberThatHasAByte) {
  const std::string schema = Ros2MsgText("unitree_go/msg/LowState");
  const std::string zeros(2000, '\0');
  BytesOut message;
  PutCdrHead(&message);
  message.PutRaw(AsBytes(zeros));
  for (const char* path : {"head[0]", "motor_state[3].q", "imu_state.gyroscope[2]", "crc"}) {
    const std::size_t first = 4 + FindField("unitree_go/msg/LowState", path).offset;
    EXPECT_EQ(What(schema, message, first), std::string(path) + " = 0");
  }
  const std::size_t q = 4 + FindField("unitree_go/msg/LowState", "motor_state[3].q").offset;
  EXPECT_EQ(What(schema, message, q + 3), "motor_state[3].q = 0");
  EXPECT_EQ(What(schema, message, 3), "");     // of the encoding
  EXPECT_EQ(What(schema, message, 1900), "");  // after the last
}

TEST(SchemaFieldTest, NamesWhatStandsAfterTexts) {
  const BytesOut event = EventMessage();
  EXPECT_EQ(What(kEventText, event, 4 + 8), "time = 0.014");
  EXPECT_EQ(What(kEventText, event, 4 + 16), "kind = 'program_end'");
  EXPECT_EQ(What(kEventText, event, 4 + 16 + 4 + 12 + 4), "text = 'it ended'");
}

TEST(SchemaFieldTest, NamesElementsAndLengthsOfSequences) {
  BytesOut message;
  EncodeTruth({.step = 1, .time = 0.5, .qpos = {1, 2, 3}, .qvel = {4, 5}}, &message);
  const std::size_t qpos = 4 + 16;
  EXPECT_EQ(What(kTruthText, message, qpos), "qpos = 3 elements");
  EXPECT_EQ(What(kTruthText, message, qpos + 8 + 2 * 8 + 1), "qpos[2] = 3");
  EXPECT_EQ(What(kTruthText, message, qpos + 8 + 3 * 8), "qvel = 2 elements");
}

TEST(SchemaFieldTest, GoesIntoTheMessagesOfRos) {
  BytesOut message;
  EncodeScene({.tree = {}, .scene = {mjcf::SceneShape{.name = "floor"}}}, 5'000'000'007, &message);
  const std::string schema = RosSchema(kSceneTopic);
  EXPECT_EQ(What(schema, message, 4), "markers = 1 elements");
  EXPECT_EQ(What(schema, message, 8), "markers[0].header.stamp.sec = 5");
  EXPECT_EQ(What(schema, message, 12), "markers[0].header.stamp.nanosec = 7");
}

TEST(SchemaFieldTest, SaysNothingOfAMessageThatDoesNotFit) {
  const BytesOut event = EventMessage();
  EXPECT_EQ(FieldWithByte(kEventText, event.span().first(30), 50), std::nullopt);
  EXPECT_EQ(FieldWithByte("another/Type x\n", event.span(), 8), std::nullopt);
  EXPECT_EQ(FieldWithByte("a/A x\n===\nMSG: a/A\na/A x\n", event.span(), 8), std::nullopt);
  EXPECT_EQ(FieldWithByte("float64[] x\n", event.span(), 200), std::nullopt);
  EXPECT_EQ(FieldWithByte("", event.span(), 8), std::nullopt);
}

}  // namespace
}  // namespace understudy::record
