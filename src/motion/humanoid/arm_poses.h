// The arm poses of the vendor's arm actions.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace understudy::motion {

inline constexpr std::size_t kArmJoints = 7;

// The joints of one arm by the vendor's names, without the side and "_joint".
inline constexpr std::array<std::string_view, kArmJoints> kArmJointNames = {
    "shoulder_pitch", "shoulder_roll", "shoulder_yaw", "elbow",
    "wrist_roll",     "wrist_pitch",   "wrist_yaw"};

// Angles [rad] of a left arm in that order. Signs are the vendor's, alike on all humanoids: pitch
// -π/2 is forwards, roll π/2 sideways, yaw turns the forearm outwards; elbow 0 is a right angle,
// π/2 straight, negative bent further. A right arm has roll, yaw, wrist roll and wrist yaw the
// other way round.
using ArmPose = std::array<double, kArmJoints>;

double Mirrored(const ArmPose& pose, std::size_t joint);  // the angle of a right arm

// A pose of both arms and the duration [s] of the motion to it.
struct ArmKey {
  double duration = 0;
  const ArmPose* left = nullptr;  // null: as in the standing pose
  const ArmPose* right = nullptr;
};

struct ArmSequence {
  int id = 0;
  std::span<const ArmKey> keys;
  bool holds = false;  // holds the last pose until released
};

inline constexpr int kReleaseArms = 99;

// Returns null if no trajectory is known for that id.
const ArmSequence* FindArmSequence(int id);

// Returns whether the vendor's robots have an action that is not simulated: a turn of the body, and
// undocumented gestures.
bool IsUnplayedArmAction(int id);

}  // namespace understudy::motion
