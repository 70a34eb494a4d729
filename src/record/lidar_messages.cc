#include "record/lidar_messages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "base/errors.h"

namespace understudy::record {
namespace {

constexpr std::size_t kEncodingBytes = 4;  // bytes of the encoding, from which alignment counts
constexpr std::uint8_t kFloat32 = 7;       // sensor_msgs/PointField
constexpr float kUnseen = 1e8F;            // m; cells that were never seen have 1e9
constexpr std::uint32_t kMostFields = 64;  // *assumed*: more than any lidar has

template <typename Number>
Number TakeAligned(BytesIn* in) {
  in->Align(sizeof(Number), kEncodingBytes);
  return in->Take<Number>();
}

// Ends with a zero, which is left out.
std::string TakeFrame(BytesIn* in) {
  in->Align(sizeof(std::uint32_t), kEncodingBytes);
  std::string text = in->TakeString();
  if (!text.empty()) text.pop_back();
  return text;
}

BytesIn BeginLidarMessage(ByteSpan message) {
  BytesIn in(message);
  const ByteSpan head = in.TakeRaw(kEncodingBytes);
  if (head[0] == std::byte{0} && head[1] == std::byte{1}) return in;
  throw RecordError("a message that is not little-endian XCDR1");
}

// Of std_msgs/Header: stamp and frame.
void TakeHeader(BytesIn* in) {
  in->TakeRaw(2 * sizeof(std::uint32_t));
  TakeFrame(in);
}

// Where x, y and z of a point begin in its bytes.
std::array<std::uint32_t, 3> TakeOffsets(BytesIn* in) {
  std::array<std::optional<std::uint32_t>, 3> offsets;
  const auto fields = TakeAligned<std::uint32_t>(in);
  if (fields > kMostFields) {
    throw RecordError("a cloud of " + std::to_string(fields) + " fields; expected " +
                      std::to_string(kMostFields) + " at most");
  }
  for (std::uint32_t i = 0; i < fields; ++i) {
    const std::string name = TakeFrame(in);
    const auto offset = TakeAligned<std::uint32_t>(in);
    const auto type = TakeAligned<std::uint8_t>(in);
    TakeAligned<std::uint32_t>(in);  // how many
    const std::size_t axis = std::string("xyz").find(name);
    if (name.size() != 1 || axis == std::string::npos) continue;
    if (type != kFloat32) {
      throw RecordError("a cloud whose " + name + " has type " + std::to_string(type) +
                        "; expected 7, float32");
    }
    offsets[axis] = offset;
  }
  if (!offsets[0] || !offsets[1] || !offsets[2]) throw RecordError("a cloud without x, y and z");
  return {*offsets[0], *offsets[1], *offsets[2]};
}

}  // namespace

std::vector<Eigen::Vector3f> ReadPointCloud(ByteSpan message) {
  BytesIn in = BeginLidarMessage(message);
  TakeHeader(&in);
  const std::uint64_t rows = TakeAligned<std::uint32_t>(&in);
  const std::uint64_t columns = TakeAligned<std::uint32_t>(&in);
  const auto offsets = TakeOffsets(&in);
  if (TakeAligned<std::uint8_t>(&in) != 0) throw RecordError("a big-endian cloud");
  const std::uint64_t point_step = TakeAligned<std::uint32_t>(&in);
  const std::uint64_t row_step = TakeAligned<std::uint32_t>(&in);
  const ByteSpan data = in.TakeRaw(TakeAligned<std::uint32_t>(&in));

  const std::uint64_t last = *std::ranges::max_element(offsets) + sizeof(float);
  const bool fits = last <= point_step && columns * point_step <= row_step &&
                    (rows == 0 || row_step <= data.size() / rows);
  if (!fits && rows * columns > 0) throw RecordError("a cloud of which points are missing");
  std::vector<Eigen::Vector3f> points;
  for (std::uint64_t i = 0; i < rows * columns; ++i) {
    BytesIn point(data.subspan(i / columns * row_step + i % columns * point_step, point_step));
    Eigen::Vector3f p;
    for (int axis = 0; axis < 3; ++axis) {
      BytesIn at = point;
      at.TakeRaw(offsets[static_cast<std::size_t>(axis)]);
      p[axis] = at.Take<float>();
    }
    if (p.allFinite() && !p.isZero()) points.push_back(p);
  }
  return points;
}

std::vector<Eigen::Vector3f> ReadHeightMap(ByteSpan message) {
  BytesIn in = BeginLidarMessage(message);
  TakeAligned<double>(&in);  // stamp
  TakeFrame(&in);            // frame
  const auto resolution = TakeAligned<float>(&in);
  const std::uint64_t width = TakeAligned<std::uint32_t>(&in);
  const std::uint64_t height = TakeAligned<std::uint32_t>(&in);
  const auto x = TakeAligned<float>(&in), y = TakeAligned<float>(&in);
  const std::uint64_t count = TakeAligned<std::uint32_t>(&in);
  if (count != width * height) {
    throw RecordError("a map of " + std::to_string(width) + " by " + std::to_string(height) +
                      " cells with " + std::to_string(count) + " heights");
  }
  BytesIn data(in.TakeRaw(count * sizeof(float)));
  std::vector<Eigen::Vector3f> cells;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t column = i % width, row = i / width;
    const Eigen::Vector3f cell(x + resolution * static_cast<float>(column),
                               y + resolution * static_cast<float>(row), data.Take<float>());
    if (cell.allFinite() && std::abs(cell.z()) < kUnseen) cells.push_back(cell);
  }
  return cells;
}

Eigen::Isometry3d ReadPose(ByteSpan message) {
  BytesIn in = BeginLidarMessage(message);
  TakeHeader(&in);
  std::array<double, 7> values{};  // x, y, z, then the quaternion x, y, z, w
  for (double& value : values) value = TakeAligned<double>(&in);
  const Eigen::Quaterniond q(values[6], values[3], values[4], values[5]);
  const Eigen::Vector3d p(values.data());
  const double length = q.norm();
  if (!p.allFinite() || !(std::abs(length - 1) < 0.01)) {
    throw RecordError("a pose whose quaternion has length " + std::to_string(length));
  }
  return Eigen::Translation3d(p) * q.normalized();
}

}  // namespace understudy::record
