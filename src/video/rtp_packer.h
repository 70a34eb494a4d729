// Packs H.264 for the network: RTP (RFC 3550) with its payload (RFC 6184).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace understudy::video {

// One source of one stream. A NAL unit that fits goes into a packet of its own, a longer one into
// fragments (FU-A).
class RtpPacker {
 public:
  using Send = std::function<void(std::span<const std::uint8_t>)>;

  static constexpr std::size_t kMostBytes = 1400;  // of a packet; *assumed*: fits any Ethernet
  static constexpr int kClockHz = 90'000;          // of timestamps

  // `source` is the SSRC. `sequence` is the number of the first packet.
  RtpPacker(std::uint32_t source, std::uint16_t sequence) : source_(source), sequence_(sequence) {}

  // Calls `send` with each packet of a frame, valid during the call. `frame` has its NAL units
  // behind start codes (Annex B); what stands before the first, and empty units, are left out. The
  // last packet has the marker.
  void Pack(std::span<const std::uint8_t> frame, std::uint32_t timestamp, const Send& send);

 private:
  void PackUnit(std::span<const std::uint8_t> unit, std::uint32_t timestamp, bool last,
                const Send& send);
  void BeginPacket(std::uint32_t timestamp, bool marker);

  std::uint32_t source_;
  std::uint16_t sequence_;
  std::vector<std::uint8_t> packet_;
};

}  // namespace understudy::video
