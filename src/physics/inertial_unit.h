// Where an inertial unit sits in the world, and what it feels there.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mjcf/mujoco_handles.h"
#include "robot/robot_values.h"

namespace understudy::physics {

// Reads attitude, rate and acceleration of a site, to the last bit what MuJoCo's gyro and
// accelerometer there would say. Those compute the forces between all bodies on the way, a
// twentieth of a standing robot's step; here only the bodies from the world to the site are gone
// through. One that is made without a site reads default values. Allocates in the constructor.
class InertialUnit {
 public:
  InertialUnit() = default;
  // `site` is the index of one of the model's sites.
  InertialUnit(const mjModel& model, int site);

  // Reads what belongs to positions and rates, once mj_step1 has computed them.
  void ReadMotion(const mjModel& model, const mjData& data);
  // Reads the acceleration, once mj_step2 has computed that of the joints. Leaves the accelerations
  // of the bodies on the way in data->cacc.
  void ReadAcceleration(const mjModel& model, mjData* data);

  const robot::ImuReading& reading() const { return reading_; }

 private:
  // A body on the way, and what its joints add to its acceleration as they turn at their rates;
  // rotation first, as MuJoCo's spatial vectors.
  struct Link {
    int body = 0;
    std::array<double, 6> by_rate{};
  };

  int site_ = -1;
  std::vector<Link> links_;  // outward
  robot::ImuReading reading_;
};

}  // namespace understudy::physics
