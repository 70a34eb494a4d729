// The makes of lidar: where each looks, and when.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include <Eigen/Core>

namespace understudy::perception {

// Time is counted in slots; in each the lidar takes one sample or is blind. A make is a row.
struct LidarLaw {
  std::string_view make;
  std::int64_t slots_per_second;
  std::int64_t cloud_slots;    // of a cloud
  std::int64_t cloud_samples;  // of these, all but the blind ones
  double beam_start;           // m along z of its frame, where all beams begin
  bool keeps_misses;           // a sample without an echo is a point at 0, and not left out
  double imu_hz;
  // Returns the direction of a slot's sample in the lidar's frame; 0 if it is blind.
  Eigen::Vector3d (*look)(std::int64_t slot);

  double cloud_hz() const {
    return static_cast<double>(slots_per_second) / static_cast<double>(cloud_slots);
  }
};

// L1, L2: a beam turns about two axes: in half a circle from one side over the lidar's z to the
//   other, then blind for as long, while that circle turns about z.
// Mid-360: four beams turn about z and nod between 7° below and 52° above its horizon.
std::span<const LidarLaw> LidarLaws();

// Returns the row of a make that is there (robot::LidarSpec).
const LidarLaw& LawOf(std::string_view make);

}  // namespace understudy::perception
