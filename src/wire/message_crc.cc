#include "wire/message_crc.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

#include "wire/crc32.h"

namespace understudy::wire {
namespace {

using GoLowCmd = unitree_go_msg_dds__LowCmd_;
using GoLowState = unitree_go_msg_dds__LowState_;
using GoMotorCmd = unitree_go_msg_dds__MotorCmd_;
using GoMotorState = unitree_go_msg_dds__MotorState_;
using GoImu = unitree_go_msg_dds__IMUState_;
using HgLowCmd = unitree_hg_msg_dds__LowCmd_;
using HgLowState = unitree_hg_msg_dds__LowState_;
using HgMotorCmd = unitree_hg_msg_dds__MotorCmd_;
using HgMotorState = unitree_hg_msg_dds__MotorState_;
using HgImu = unitree_hg_msg_dds__IMUState_;

static_assert(std::endian::native == std::endian::little, "the layout is that of the robot's CPU");

// Sizes and offsets of the vendor's C++ objects, compiled from its headers (docs/sources.md#crc).
static_assert(sizeof(GoLowCmd) == 812 && sizeof(GoMotorCmd) == 36);
static_assert(offsetof(GoLowCmd, level_flag) == 2 && offsetof(GoLowCmd, sn) == 4);
static_assert(offsetof(GoLowCmd, version) == 12 && offsetof(GoLowCmd, bandwidth) == 20);
static_assert(offsetof(GoLowCmd, motor_cmd) == 24 && offsetof(GoLowCmd, bms_cmd) == 744);
static_assert(offsetof(GoLowCmd, wireless_remote) == 748 && offsetof(GoLowCmd, led) == 788);
static_assert(offsetof(GoLowCmd, fan) == 800 && offsetof(GoLowCmd, gpio) == 802);
static_assert(offsetof(GoLowCmd, reserve) == 804 && offsetof(GoLowCmd, crc) == 808);

static_assert(sizeof(GoLowState) == 1180 && sizeof(GoMotorState) == 48 && sizeof(GoImu) == 56);
static_assert(offsetof(GoLowState, imu_state) == 24 && offsetof(GoLowState, motor_state) == 80);
static_assert(offsetof(GoLowState, bms_state) == 1040 && offsetof(GoLowState, foot_force) == 1084);
static_assert(offsetof(GoLowState, foot_force_est) == 1092 && offsetof(GoLowState, tick) == 1100);
static_assert(offsetof(GoLowState, wireless_remote) == 1104);
static_assert(offsetof(GoLowState, bit_flag) == 1144 && offsetof(GoLowState, adc_reel) == 1148);
static_assert(offsetof(GoLowState, temperature_ntc1) == 1152);
static_assert(offsetof(GoLowState, power_v) == 1156 && offsetof(GoLowState, power_a) == 1160);
static_assert(offsetof(GoLowState, fan_frequency) == 1164 && offsetof(GoLowState, crc) == 1176);

static_assert(sizeof(HgLowCmd) == 1004 && sizeof(HgMotorCmd) == 28);
static_assert(offsetof(HgLowCmd, mode_machine) == 1 && offsetof(HgLowCmd, motor_cmd) == 4);
static_assert(offsetof(HgLowCmd, reserve) == 984 && offsetof(HgLowCmd, crc) == 1000);

static_assert(sizeof(HgLowState) == 2092 && sizeof(HgMotorState) == 56 && sizeof(HgImu) == 56);
static_assert(offsetof(HgLowState, mode_pr) == 8 && offsetof(HgLowState, mode_machine) == 9);
static_assert(offsetof(HgLowState, tick) == 12 && offsetof(HgLowState, imu_state) == 16);
static_assert(offsetof(HgLowState, motor_state) == 72);
static_assert(offsetof(HgLowState, wireless_remote) == 2032);
static_assert(offsetof(HgLowState, reserve) == 2072 && offsetof(HgLowState, crc) == 2088);

// The words of a message that its CRC covers, all but the last, with zeros where the gaps are.
template <typename Msg>
class CoveredWords {
 public:
  constexpr CoveredWords() { words_.fill(0xFFFFFFFF); }

  // Marks the bytes [begin, end) of the message as a gap. They lie within one word.
  constexpr CoveredWords& Gap(std::size_t begin, std::size_t end) {
    for (std::size_t byte = begin; byte < end; ++byte) words_[byte / 4] &= ~(0xFFU << byte % 4 * 8);
    return *this;
  }

  std::uint32_t Crc(const Msg& message) const {
    std::array<std::uint32_t, kWords> covered;
    std::memcpy(covered.data(), &message, sizeof(covered));
    for (std::size_t i = 0; i < kWords; ++i) covered[i] &= words_[i];
    return Crc32(covered);
  }

 private:
  static constexpr std::size_t kWords = sizeof(Msg) / 4 - 1;
  static_assert(offsetof(Msg, crc) == 4 * kWords);

  std::array<std::uint32_t, kWords> words_{};
};

constexpr auto kGoLowCmdWords = [] {
  CoveredWords<GoLowCmd> words;
  words.Gap(22, 24).Gap(803, 804);
  for (std::size_t motor = 24; motor < 744; motor += sizeof(GoMotorCmd)) {
    words.Gap(motor + 1, motor + 4);
  }
  return words;
}();

constexpr auto kGoLowStateWords = [] {
  CoveredWords<GoLowState> words;
  words.Gap(22, 24).Gap(24 + 53, 24 + 56).Gap(1145, 1148).Gap(1154, 1156);
  for (std::size_t motor = 80; motor < 1040; motor += sizeof(GoMotorState)) {
    words.Gap(motor + 1, motor + 4).Gap(motor + 33, motor + 36);
  }
  return words;
}();

constexpr auto kHgLowCmdWords = [] {
  CoveredWords<HgLowCmd> words;
  words.Gap(2, 4);
  for (std::size_t motor = 4; motor < 984; motor += sizeof(HgMotorCmd)) {
    words.Gap(motor + 1, motor + 4);
  }
  return words;
}();

constexpr auto kHgLowStateWords = [] {
  CoveredWords<HgLowState> words;
  words.Gap(10, 12).Gap(16 + 54, 16 + 56);
  for (std::size_t motor = 72; motor < 2032; motor += sizeof(HgMotorState)) {
    words.Gap(motor + 1, motor + 4);
  }
  return words;
}();

}  // namespace

std::uint32_t MessageCrc(const GoLowCmd& message) { return kGoLowCmdWords.Crc(message); }
std::uint32_t MessageCrc(const GoLowState& message) { return kGoLowStateWords.Crc(message); }
std::uint32_t MessageCrc(const HgLowCmd& message) { return kHgLowCmdWords.Crc(message); }
std::uint32_t MessageCrc(const HgLowState& message) { return kHgLowStateWords.Crc(message); }

}  // namespace understudy::wire
