#include "wire/message_crc.h"

#include <cstddef>
#include <cstring>
#include <vector>

#include <gmock/gmock.h>

#include "tests/wire/go_command.h"

namespace understudy::wire {
namespace {

// The six vectors are the vendor's: computed by both its C++ and its Python SDK
// (docs/dev/sources.md#crc).

TEST(MessageCrcTest, OfZerosIsTheVendors) {
  EXPECT_EQ(MessageCrc(unitree_go_msg_dds__LowCmd_{}), 0x4b5a4880);
  EXPECT_EQ(MessageCrc(unitree_go_msg_dds__LowState_{}), 0x85f11ea6);
  EXPECT_EQ(MessageCrc(unitree_hg_msg_dds__LowCmd_{}), 0xfe172f9f);
  EXPECT_EQ(MessageCrc(unitree_hg_msg_dds__LowState_{}), 0xd64bb04a);
}

TEST(MessageCrcTest, OfAnInitialGoCommandIsTheVendors) {
  EXPECT_EQ(MessageCrc(InitialGoCommand()), 0x06e577cd);
}

TEST(MessageCrcTest, OfAnHgCommandIsTheVendors) {
  unitree_hg_msg_dds__LowCmd_ message{};
  message.mode_machine = 5;
  for (int i = 0; i < 29; ++i) {
    message.motor_cmd[i].mode = 1;
    message.motor_cmd[i].kp = 60;
    message.motor_cmd[i].kd = 1;
  }
  EXPECT_EQ(MessageCrc(message), 0x7ee93ff9);
}

// Flips each byte in turn and returns the offsets that do not show in the CRC.
template <typename Msg>
std::vector<std::size_t> UnseenBytes() {
  const std::uint32_t zero = MessageCrc(Msg{});
  std::vector<std::size_t> unseen;
  for (std::size_t offset = 0; offset < sizeof(Msg); ++offset) {
    Msg message{};
    reinterpret_cast<unsigned char*>(&message)[offset] = 0x5A;
    if (MessageCrc(message) == zero) unseen.push_back(offset);
  }
  return unseen;
}

std::vector<std::size_t> Ranges(const std::vector<std::pair<std::size_t, std::size_t>>& once,
                                std::size_t begin, std::size_t stride, std::size_t count,
                                const std::vector<std::pair<std::size_t, std::size_t>>& each) {
  std::vector<std::size_t> offsets;
  for (const auto& [first, last] : once) {
    for (std::size_t i = first; i < last; ++i) offsets.push_back(i);
  }
  for (std::size_t n = 0; n < count; ++n) {
    for (const auto& [first, last] : each) {
      for (std::size_t i = first; i < last; ++i) offsets.push_back(begin + n * stride + i);
    }
  }
  return offsets;
}

using ::testing::UnorderedElementsAreArray;

TEST(MessageCrcTest, SeesAllButTheGapsAndItself) {
  EXPECT_THAT(
      UnseenBytes<unitree_go_msg_dds__LowCmd_>(),
      UnorderedElementsAreArray(Ranges({{22, 24}, {803, 804}, {808, 812}}, 24, 36, 20, {{1, 4}})));
  EXPECT_THAT(UnseenBytes<unitree_go_msg_dds__LowState_>(),
              UnorderedElementsAreArray(
                  Ranges({{22, 24}, {77, 80}, {1145, 1148}, {1154, 1156}, {1176, 1180}}, 80, 48, 20,
                         {{1, 4}, {33, 36}})));
  EXPECT_THAT(UnseenBytes<unitree_hg_msg_dds__LowCmd_>(),
              UnorderedElementsAreArray(Ranges({{2, 4}, {1000, 1004}}, 4, 28, 35, {{1, 4}})));
  EXPECT_THAT(
      UnseenBytes<unitree_hg_msg_dds__LowState_>(),
      UnorderedElementsAreArray(Ranges({{10, 12}, {70, 72}, {2088, 2092}}, 72, 56, 35, {{1, 4}})));
}

}  // namespace
}  // namespace understudy::wire
