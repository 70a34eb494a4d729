// What the arms do in each of the vendor's arm actions.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace understudy::motion {

inline constexpr std::size_t kArmJoints = 7;

// Joints of one arm by the vendor's names, without the side before and "_joint" behind.
inline constexpr std::array<std::string_view, kArmJoints> kArmJointNames = {
    "shoulder_pitch", "shoulder_roll", "shoulder_yaw", "elbow",
    "wrist_roll",     "wrist_pitch",   "wrist_yaw"};

// Angles [rad] of a left arm in that order. Signs are the vendor's, alike on all humanoids: pitch
// -π/2 is forwards, roll π/2 sideways, yaw turns the forearm outwards; elbow 0 is a right angle,
// π/2 straight, negative bent further. A right arm has roll, yaw, wrist roll and wrist yaw the
// other way round.
using ArmPose = std::array<double, kArmJoints>;

double Mirrored(const ArmPose& pose, std::size_t joint);  // as a right arm has it

// Where both arms are to be, and how long they take from where they were, s.
struct ArmKey {
  double duration = 0;
  const ArmPose* left = nullptr;  // null: as when standing
  const ArmPose* right = nullptr;
};

struct ArmAction {
  int id = 0;
  std::span<const ArmKey> keys;
  bool holds = false;  // stays in the last pose until released
};

inline constexpr int kReleaseArms = 99;

// Null where no trajectory is known for that number.
const ArmAction* FindArmAction(int id);

// What the vendor's robots have beyond that: a turn of the body, and gestures nobody describes.
bool IsUnplayedArmAction(int id);

}  // namespace understudy::motion
