#include "record/cdr_field.h"

#include <gmock/gmock.h>

#include "bus/cdr.h"
#include "bus/writer.h"
#include "idl/unitree_go.h"
#include "idl/unitree_hg.h"
#include "tests/record/mcap_files.h"

namespace understudy::record {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// Against bytes that Cyclone made: one message of each type, with a number in its field.
template <typename Msg>
class Wire {
 public:
  Wire(int domain, const dds_topic_descriptor& descriptor)
      : participant_("lo", domain),
        reader_(participant_, "rt/a", descriptor),
        writer_(participant_, {"rt/a", &descriptor}) {}

  std::optional<double> Reads(const Msg& message, const CdrField& field) {
    std::optional<double> value;
    EXPECT_TRUE(writer_.Write(message));
    reader_.Take([&](const bus::CdrSample& sample) { value = ReadField(field, sample.bytes()); });
    return value;
  }

 private:
  bus::Participant participant_;
  bus::CdrReader reader_;
  bus::Writer<Msg> writer_;
};

TEST(CdrFieldTest, FindsThePlacesOfNumbers) {
  Wire<unitree_go_msg_dds__LowState_> wire(209, unitree_go_msg_dds__LowState__desc);
  unitree_go_msg_dds__LowState_ state{};
  state.motor_state[3].q = 0.5;
  state.imu_state.gyroscope[2] = -0.25;
  state.bms_state.cell_vol[14] = 3700;
  state.tick = 12345;
  state.crc = 0xFFFFFFFF;
  const auto reads = [&](const char* path) {
    return wire.Reads(state, FindField("unitree_go/msg/LowState", path));
  };
  EXPECT_EQ(reads("motor_state[3].q"), 0.5);
  EXPECT_EQ(reads("imu_state.gyroscope[2]"), -0.25);
  EXPECT_EQ(reads("bms_state.cell_vol[14]"), 3700);
  EXPECT_EQ(reads("tick"), 12345);
  EXPECT_EQ(reads("crc"), 4294967295);
}

TEST(CdrFieldTest, FindsThePlacesOfNumbersInAHumanoidsCommand) {
  Wire<unitree_hg_msg_dds__LowCmd_> wire(210, unitree_hg_msg_dds__LowCmd__desc);
  unitree_hg_msg_dds__LowCmd_ command{};
  command.motor_cmd[34].kd = 1.5;
  command.motor_cmd[0].mode = 1;
  const auto reads = [&](const char* path) {
    return wire.Reads(command, FindField("unitree_hg/msg/LowCmd", path));
  };
  EXPECT_EQ(reads("motor_cmd[34].kd"), 1.5);
  EXPECT_EQ(reads("motor_cmd[0].mode"), 1);
}

TEST(CdrFieldTest, ReadsANumber) {
  BytesOut message;
  message.PutRaw(AsBytes(std::string("\0\1\0\0", 4)));
  message.Put(std::int32_t{-7});
  message.Put(std::uint32_t{9});
  const CdrField sec = FindField("builtin_interfaces/msg/Time", "sec");
  const CdrField nanosec = FindField("builtin_interfaces/msg/Time", "nanosec");
  EXPECT_EQ(ReadField(sec, message.span()), -7);
  EXPECT_EQ(ReadField(nanosec, message.span()), 9);
  EXPECT_EQ(ReadField(nanosec, message.span().first(11)), std::nullopt);
  EXPECT_EQ(ReadField(sec, AsBytes(std::string("\0\0\0\0\0\0\0\1", 8))), std::nullopt);
}

TEST(CdrFieldTest, NamesTheNearestField) {
  const auto fault = [](const std::string& path) {
    return [path] { FindField("unitree_go/msg/LowState", path); };
  };
  EXPECT_THAT(fault("tik"), ThrowsMessage<RecordError>(HasSubstr("did you mean 'tick'?")));
  EXPECT_THAT(fault("motor_state[20].q"),
              ThrowsMessage<RecordError>(HasSubstr("expected an index from 0 to 19")));
  EXPECT_THAT(fault("motor_state.q"),
              ThrowsMessage<RecordError>(HasSubstr("expected an index from 0 to 19")));
  EXPECT_THAT(fault("motor_state[x].q"),
              ThrowsMessage<RecordError>(HasSubstr("expected a name and [index]")));
  EXPECT_THAT(fault("tick.q"), ThrowsMessage<RecordError>(HasSubstr("is a number")));
  EXPECT_THAT(fault("tick[0]"), ThrowsMessage<RecordError>(HasSubstr("is no array")));
  EXPECT_THAT(fault("imu_state"), ThrowsMessage<RecordError>(HasSubstr("has no field ''")));
}

TEST(CdrFieldTest, RefusesWhatHasNoFixedPlace) {
  EXPECT_THAT([] { FindField("unitree_go/msg/HeightMap", "data"); },
              ThrowsMessage<RecordError>(HasSubstr("has no fixed place")));
  EXPECT_THAT([] { FindField("unitree_go/msg/HeightMap", "width"); },
              ThrowsMessage<RecordError>(HasSubstr("frame_id: has no fixed place")));
}

}  // namespace
}  // namespace understudy::record
