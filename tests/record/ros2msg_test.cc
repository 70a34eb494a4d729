#include "record/ros2msg.h"

#include <gmock/gmock.h>

#include "idl/type_table.h"

namespace understudy::record {
namespace {

TEST(Ros2MsgTest, KnowsTheFieldsOfAllTypesOfTheVendor) {
  EXPECT_EQ(RosMessages().size(), MessageTypes().size());
  for (const MessageType& type : MessageTypes()) {
    EXPECT_TRUE(RosMessages().contains(RosTypeName(type.name))) << type.name;
  }
}

TEST(Ros2MsgTest, NamesTypesAsRosDoesAndBack) {
  EXPECT_EQ(RosTypeName("unitree_go::msg::dds_::LowState_"), "unitree_go/msg/LowState");
  for (const MessageType& type : MessageTypes()) {
    EXPECT_EQ(TypeOnWire(RosTypeName(type.name)), type.name);
  }
  EXPECT_EQ(TypeOnWire("nonsense"), "");
}

TEST(Ros2MsgTest, NamesTopicsAsRosDoes) {
  EXPECT_EQ(RosTopicName("rt/lf/lowstate"), "/lf/lowstate");
  EXPECT_EQ(RosTopicName("hello"), "hello");
}

TEST(Ros2MsgTest, WritesNumbersStringsAndSequences) {
  EXPECT_EQ(Ros2MsgText("unitree_go/msg/AudioData"), "uint64 time_frame\nuint8[] data\n");
  EXPECT_EQ(Ros2MsgText("std_msgs/msg/String"), "string data\n");
}

TEST(Ros2MsgTest, WritesTheTypesThatATypeConsistsOf) {
  EXPECT_EQ(Ros2MsgText("geometry_msgs/msg/PoseStamped"),
            "std_msgs/Header header\n"
            "geometry_msgs/Pose pose\n" +
                std::string(80, '=') +
                "\nMSG: std_msgs/Header\n"
                "builtin_interfaces/Time stamp\n"
                "string frame_id\n" +
                std::string(80, '=') +
                "\nMSG: builtin_interfaces/Time\n"
                "int32 sec\n"
                "uint32 nanosec\n" +
                std::string(80, '=') +
                "\nMSG: geometry_msgs/Pose\n"
                "geometry_msgs/Point position\n"
                "geometry_msgs/Quaternion orientation\n" +
                std::string(80, '=') +
                "\nMSG: geometry_msgs/Point\n"
                "float64 x\n"
                "float64 y\n"
                "float64 z\n" +
                std::string(80, '=') +
                "\nMSG: geometry_msgs/Quaternion\n"
                "float64 x\n"
                "float64 y\n"
                "float64 z\n"
                "float64 w\n");
}

TEST(Ros2MsgTest, WritesArraysOfStructs) {
  EXPECT_THAT(Ros2MsgText("unitree_hg/msg/LowState"),
              ::testing::HasSubstr("unitree_hg/MotorState[35] motor_state\n"));
}

}  // namespace
}  // namespace understudy::record
