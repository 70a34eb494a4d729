#include "video/rtp_packer.h"

#include <cstdint>
#include <vector>

#include <gmock/gmock.h>

namespace understudy::video {
namespace {

using Bytes = std::vector<std::uint8_t>;
using testing::Each;
using testing::ElementsAre;
using testing::SizeIs;

constexpr std::size_t kHead = 12;  // bytes of RTP

Bytes StartCode(int zeros, Bytes unit) {
  Bytes bytes(static_cast<std::size_t>(zeros), 0);
  bytes.push_back(1);
  bytes.insert(bytes.end(), unit.begin(), unit.end());
  return bytes;
}

Bytes Joined(const std::vector<Bytes>& parts) {
  Bytes all;
  for (const Bytes& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

// A unit of a frame that stands for itself (0x65), of bytes that count up from 1 and are never 0.
Bytes Long(std::size_t size) {
  Bytes unit(size, 0x65);
  for (std::size_t i = 1; i < size; ++i) unit[i] = static_cast<std::uint8_t>(1 + i % 255);
  return unit;
}

std::vector<Bytes> Packed(RtpPacker* packer, const Bytes& frame, std::uint32_t timestamp = 0) {
  std::vector<Bytes> packets;
  packer->Pack(frame, timestamp, [&](std::span<const std::uint8_t> packet) {
    packets.emplace_back(packet.begin(), packet.end());
  });
  return packets;
}

Bytes PayloadOf(const Bytes& packet) { return {packet.begin() + kHead, packet.end()}; }
bool IsMarked(const Bytes& packet) { return (packet[1] & 0x80) != 0; }
int NumberOf(const Bytes& packet) { return packet[2] << 8 | packet[3]; }

// What a reader makes of the packets by RFC 6184: the units behind start codes.
Bytes Unpacked(const std::vector<Bytes>& packets) {
  Bytes frame;
  for (const Bytes& packet : packets) {
    const Bytes payload = PayloadOf(packet);
    const bool fragment = (payload[0] & 0x1F) == 28;
    if (!fragment || (payload[1] & 0x80) != 0) frame.insert(frame.end(), {0, 0, 0, 1});
    if (fragment && (payload[1] & 0x80) != 0) {
      frame.push_back(static_cast<std::uint8_t>((payload[0] & 0xE0) | (payload[1] & 0x1F)));
    }
    frame.insert(frame.end(), payload.begin() + (fragment ? 2 : 0), payload.end());
  }
  return frame;
}

TEST(RtpPackerTest, HeadsAPacketAsRfc3550HasIt) {
  RtpPacker packer(0x01020304, 0xA0B0);
  const auto packets = Packed(&packer, StartCode(3, {0x65, 7}), 0x11223344);
  EXPECT_THAT(packets, ElementsAre(Bytes{0x80, 0x80 | 96, 0xA0, 0xB0, 0x11, 0x22, 0x33, 0x44, 1, 2,
                                         3, 4, 0x65, 7}));
}

TEST(RtpPackerTest, PutsEachUnitThatFitsIntoAPacketOfItsOwn) {
  RtpPacker packer(1, 0);
  const auto packets = Packed(
      &packer,
      Joined({StartCode(3, {0x67, 1, 0, 2}), StartCode(2, {0x68, 3}), StartCode(3, {0x65, 4, 5})}));
  ASSERT_THAT(packets, SizeIs(3));
  EXPECT_EQ(PayloadOf(packets[0]), (Bytes{0x67, 1, 0, 2}));
  EXPECT_EQ(PayloadOf(packets[1]), (Bytes{0x68, 3}));
  EXPECT_EQ(PayloadOf(packets[2]), (Bytes{0x65, 4, 5}));
}

TEST(RtpPackerTest, MarksTheLastPacketOfAFrameAlone) {
  RtpPacker packer(1, 0);
  const auto packets = Packed(&packer, Joined({StartCode(3, {0x67, 1}), StartCode(3, Long(4000))}));
  ASSERT_THAT(packets, SizeIs(4));
  for (std::size_t i = 0; i < packets.size(); ++i) EXPECT_EQ(IsMarked(packets[i]), i == 3) << i;
}

TEST(RtpPackerTest, NumbersPacketsOnAcrossFramesAndBeginsAnewAfterTheLastNumber) {
  RtpPacker packer(1, 0xFFFE);
  std::vector<int> numbers;
  for (int frame = 0; frame < 2; ++frame) {
    for (const Bytes& packet : Packed(&packer, StartCode(3, Long(2000)))) {
      numbers.push_back(NumberOf(packet));
    }
  }
  EXPECT_THAT(numbers, ElementsAre(0xFFFE, 0xFFFF, 0, 1));
}

TEST(RtpPackerTest, CutsAUnitThatDoesNotFitIntoFragmentsThatDo) {
  constexpr std::size_t kFits = RtpPacker::kMostBytes - kHead;
  RtpPacker packer(1, 0);
  EXPECT_THAT(Packed(&packer, StartCode(3, Long(kFits))), ElementsAre(SizeIs(kFits + kHead)));
  const auto packets = Packed(&packer, StartCode(3, Long(kFits + 1)));
  ASSERT_THAT(packets, SizeIs(2));
  EXPECT_THAT(packets, Each(SizeIs(testing::Le(RtpPacker::kMostBytes))));
  // FU-A with the unit's importance; first and last of type 5.
  EXPECT_EQ(PayloadOf(packets[0])[0], 0x60 | 28);
  EXPECT_EQ(PayloadOf(packets[0])[1], 0x80 | 5);
  EXPECT_EQ(PayloadOf(packets[1])[0], 0x60 | 28);
  EXPECT_EQ(PayloadOf(packets[1])[1], 0x40 | 5);
}

TEST(RtpPackerTest, LosesNoByteOfAUnitOfAnyLength) {
  RtpPacker packer(1, 0);
  for (const std::size_t size : {1U, 2U, 1387U, 1388U, 1389U, 2773U, 2774U, 100'000U}) {
    const Bytes frame = StartCode(3, Long(size));
    EXPECT_EQ(Unpacked(Packed(&packer, frame)), frame) << size;
  }
}

TEST(RtpPackerTest, SendsNothingOfAFrameWithoutUnits) {
  RtpPacker packer(1, 0);
  for (const Bytes& frame : {Bytes{}, Bytes{0, 0}, Bytes{1, 2, 3}, StartCode(3, {}),
                             Joined({StartCode(2, {}), StartCode(2, {})}), Bytes(50, 0)}) {
    EXPECT_THAT(Packed(&packer, frame), SizeIs(0));
  }
}

TEST(RtpPackerTest, LeavesOutTheZerosBehindAUnit) {
  RtpPacker packer(1, 0);
  const auto packets =
      Packed(&packer, Joined({StartCode(3, {0x65, 1, 0, 0, 0}), StartCode(2, {0x41, 2, 0})}));
  ASSERT_THAT(packets, SizeIs(2));
  EXPECT_EQ(PayloadOf(packets[0]), (Bytes{0x65, 1}));
  EXPECT_EQ(PayloadOf(packets[1]), (Bytes{0x41, 2}));
}

}  // namespace
}  // namespace understudy::video
