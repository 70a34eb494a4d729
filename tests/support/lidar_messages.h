// Messages of a lidar as they are on the wire, small ones.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "record/bytes.h"

namespace understudy::test {

constexpr std::size_t kCdrHead = 4;  // bytes, from which alignment counts

template <typename Number>
void PutAligned(Number number, record::BytesOut* out) {
  out->Align(sizeof(Number), kCdrHead);
  out->Put(number);
}

inline void PutText(const std::string& text, record::BytesOut* out) {
  out->Align(4, kCdrHead);
  out->PutString(text + '\0');
}

inline record::BytesOut BeginMessage() {
  record::BytesOut out;
  out.PutRaw(record::AsBytes(std::string("\0\1\0\0", kCdrHead)));
  return out;
}

inline record::BytesOut BeginStamped(const std::string& frame) {
  record::BytesOut out = BeginMessage();
  out.Put(std::uint32_t{7});
  out.Put(std::uint32_t{8});
  PutText(frame, &out);
  return out;
}

struct MadeCloud {
  std::vector<std::array<float, 3>> points{};
  std::uint8_t type = 7;          // of x, y and z
  std::uint32_t point_step = 20;  // bytes, of which x, y and z are those from the fifth on
  std::uint32_t missing = 0;      // bytes at the end
};

// A sensor_msgs/PointCloud2.
inline record::BytesOut CloudMessage(const MadeCloud& cloud) {
  record::BytesOut out = BeginStamped("utlidar_lidar");
  const auto count = static_cast<std::uint32_t>(cloud.points.size());
  PutAligned(std::uint32_t{1}, &out);
  PutAligned(count, &out);
  PutAligned(std::uint32_t{4}, &out);
  std::uint32_t offset = 0;
  for (const char* name : {"intensity", "x", "y", "z"}) {
    PutText(name, &out);
    PutAligned(offset, &out);
    PutAligned(offset == 0 ? std::uint8_t{7} : cloud.type, &out);
    PutAligned(std::uint32_t{1}, &out);
    offset += 4;
  }
  PutAligned(std::uint8_t{0}, &out);
  PutAligned(cloud.point_step, &out);
  PutAligned(cloud.point_step * count, &out);
  record::BytesOut data;
  for (const auto& point : cloud.points) {
    data.Put(50.0F);
    for (const float x : point) data.Put(x);
    data.Put(std::uint32_t{0});
  }
  PutAligned(static_cast<std::uint32_t>(data.size() - cloud.missing), &out);
  out.PutRaw(data.span().first(data.size() - cloud.missing));
  out.Put(std::uint8_t{1});  // dense
  return out;
}

// A unitree_go/HeightMap of `width` columns with cells of 0.5 m, of which the first is at 1, 2.
inline record::BytesOut HeightMapMessage(std::uint32_t width, std::uint32_t height,
                                         const std::vector<float>& heights) {
  record::BytesOut out = BeginMessage();
  PutAligned(1.5, &out);
  PutText("odom", &out);
  PutAligned(0.5F, &out);
  PutAligned(width, &out);
  PutAligned(height, &out);
  PutAligned(1.0F, &out);
  PutAligned(2.0F, &out);
  PutAligned(static_cast<std::uint32_t>(heights.size()), &out);
  for (const float z : heights) PutAligned(z, &out);
  return out;
}

// A geometry_msgs/PoseStamped: x, y, z, then the quaternion x, y, z, w.
inline record::BytesOut PoseMessage(const std::array<double, 7>& values) {
  record::BytesOut out = BeginStamped("odom");
  for (const double value : values) PutAligned(value, &out);
  return out;
}

}  // namespace understudy::test
