#include "wire/message_crc.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

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

// Sizes and offsets of the vendor's C++ objects, compiled from its headers
// (docs/dev/sources.md#crc).
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

// The words of a message that its CRC covers, all but the last, with zeros in the padding.
template <typename Msg>
class CoveredWords {
 public:
  constexpr CoveredWords() { words_.fill(0xFFFFFFFF); }

  // Marks the bytes [begin, end) of the message as padding. They must be within one word.
  constexpr CoveredWords& Gap(std::size_t begin, std::size_t end) {
    for (std::size_t byte = begin; byte < end; ++byte) words_[byte / 4] &= ~(0xFFU << byte % 4 * 8);
    return *this;
  }

  // Marks the bytes [from, to) of each motor, of `size` bytes, in [begin, end).
  constexpr CoveredWords& GapInEach(std::size_t begin, std::size_t end, std::size_t size,
                                    std::size_t from, std::size_t to) {
    for (; begin < end; begin += size) Gap(begin + from, begin + to);
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

constexpr auto kGoLowCmdWords =
    CoveredWords<GoLowCmd>().Gap(22, 24).Gap(803, 804).GapInEach(24, 744, sizeof(GoMotorCmd), 1, 4);

constexpr auto kGoLowStateWords = CoveredWords<GoLowState>()
                                      .Gap(22, 24)
                                      .Gap(24 + 53, 24 + 56)
                                      .Gap(1145, 1148)
                                      .Gap(1154, 1156)
                                      .GapInEach(80, 1040, sizeof(GoMotorState), 1, 4)
                                      .GapInEach(80, 1040, sizeof(GoMotorState), 33, 36);

constexpr auto kHgLowCmdWords =
    CoveredWords<HgLowCmd>().Gap(2, 4).GapInEach(4, 984, sizeof(HgMotorCmd), 1, 4);

constexpr auto kHgLowStateWords = CoveredWords<HgLowState>()
                                      .Gap(10, 12)
                                      .Gap(16 + 54, 16 + 56)
                                      .GapInEach(72, 2032, sizeof(HgMotorState), 1, 4);

constexpr std::uint32_t kPolynomial = 0x04C11DB7;
constexpr std::size_t kWordsAtOnce = 4;
constexpr std::size_t kTables = 4 * kWordsAtOnce;

using Tables = std::array<std::array<std::uint32_t, 256>, kTables>;

// kTable[n][b] is the contribution of byte b if n more bytes follow it in its group of words
// ("slicing by 16"): one independent look-up per byte.
constexpr Tables kTable = [] {
  Tables tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t crc = byte << 24;
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc << 1) ^ ((crc & 0x80000000U) != 0 ? kPolynomial : 0);
    }
    tables[0][byte] = crc;
  }
  for (std::size_t n = 1; n < kTables; ++n) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t crc = tables[n - 1][byte];
      tables[n][byte] = (crc << 8) ^ tables[0][crc >> 24];
    }
  }
  return tables;
}();

// The contribution of a word that `after` words follow in its group. Forced inline: as a call,
// which -O2 prefers, the CRC takes twice as long.
[[gnu::always_inline]] inline std::uint32_t Slice(std::uint32_t word, std::size_t after) {
  return kTable[4 * after + 3][word >> 24] ^ kTable[4 * after + 2][(word >> 16) & 0xFF] ^
         kTable[4 * after + 1][(word >> 8) & 0xFF] ^ kTable[4 * after][word & 0xFF];
}

}  // namespace

std::uint32_t MessageCrc(const GoLowCmd& message) { return kGoLowCmdWords.Crc(message); }
std::uint32_t MessageCrc(const GoLowState& message) { return kGoLowStateWords.Crc(message); }
std::uint32_t MessageCrc(const HgLowCmd& message) { return kHgLowCmdWords.Crc(message); }
std::uint32_t MessageCrc(const HgLowState& message) { return kHgLowStateWords.Crc(message); }

std::uint32_t Crc32(std::span<const std::uint32_t> words) {
  std::uint32_t crc = 0xFFFFFFFF;
  std::size_t i = 0;
  for (; i + kWordsAtOnce <= words.size(); i += kWordsAtOnce) {
    crc = Slice(crc ^ words[i], 3) ^ Slice(words[i + 1], 2) ^ Slice(words[i + 2], 1) ^
          Slice(words[i + 3], 0);
  }
  for (; i < words.size(); ++i) crc = Slice(crc ^ words[i], 0);
  return crc;
}

}  // namespace understudy::wire
