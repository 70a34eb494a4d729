#include "video/rtp_packer.h"

#include <algorithm>
#include <array>

namespace understudy::video {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::uint8_t kVersion = 2 << 6;
constexpr std::uint8_t kMarker = 1 << 7;
constexpr std::uint8_t kPayloadType = 96;  // measured: a Go2
constexpr std::size_t kHeaderBytes = 12;
// RFC 6184, 5.3 and 5.8: of the byte before a unit, and of the two before a fragment.
constexpr std::uint8_t kImportance = 0xE0;  // F and NRI
constexpr std::uint8_t kType = 0x1F;
constexpr std::uint8_t kFragment = 28;  // FU-A
constexpr std::uint8_t kFirst = 1 << 7;
constexpr std::uint8_t kLast = 1 << 6;

constexpr std::array<std::uint8_t, 3> kStartCode = {0, 0, 1};

// The units of a frame, without the zeros between them.
std::vector<Bytes> UnitsOf(Bytes frame) {
  std::vector<Bytes> units;
  auto at = std::search(frame.begin(), frame.end(), kStartCode.begin(), kStartCode.end());
  while (at != frame.end()) {
    const auto begin = at + kStartCode.size();
    at = std::search(begin, frame.end(), kStartCode.begin(), kStartCode.end());
    auto end = at;
    while (end != begin && *(end - 1) == 0) --end;
    if (end != begin) units.emplace_back(begin, end);
  }
  return units;
}

}  // namespace

void RtpPacker::Pack(Bytes frame, std::uint32_t timestamp, const Send& send) {
  const std::vector<Bytes> units = UnitsOf(frame);
  for (const Bytes& unit : units) PackUnit(unit, timestamp, &unit == &units.back(), send);
}

void RtpPacker::PackUnit(Bytes unit, std::uint32_t timestamp, bool last, const Send& send) {
  if (unit.size() <= kMostBytes - kHeaderBytes) {
    BeginPacket(timestamp, last);
    packet_.insert(packet_.end(), unit.begin(), unit.end());
    send(packet_);
    return;
  }
  constexpr std::size_t kMostPiece = kMostBytes - kHeaderBytes - 2;
  const std::uint8_t head = unit.front();
  Bytes rest = unit.subspan(1);
  for (std::uint8_t flag = kFirst; !rest.empty(); flag = 0) {
    const Bytes piece = rest.first(std::min(rest.size(), kMostPiece));
    rest = rest.subspan(piece.size());
    if (rest.empty()) flag |= kLast;
    BeginPacket(timestamp, last && rest.empty());
    packet_.push_back((head & kImportance) | kFragment);
    packet_.push_back(flag | (head & kType));
    packet_.insert(packet_.end(), piece.begin(), piece.end());
    send(packet_);
  }
}

void RtpPacker::BeginPacket(std::uint32_t timestamp, bool marker) {
  packet_.clear();
  packet_.push_back(kVersion);
  packet_.push_back((marker ? kMarker : 0) | kPayloadType);
  const auto put = [this](std::uint32_t number, int bytes) {
    while (bytes-- > 0) packet_.push_back(static_cast<std::uint8_t>(number >> 8 * bytes));
  };
  put(sequence_++, 2);
  put(timestamp, 4);
  put(source_, 4);
}

}  // namespace understudy::video
