#include "motion/humanoid/arm_poses.h"

#include <algorithm>

namespace understudy::motion {
namespace {

// All angles and times are assumed: our version of the gestures that the vendor names
// (docs/dev/sources.md#arm-actions). Known of hardware: a wave takes 4.19 s. Which ones hold is
// read from the vendor's example, which releases after those.

// Left arms:                      pitch  roll  yaw    elbow wrist
constexpr ArmPose kSideways = {0, 1.4, 0, 1.5, 0, 0, 0};
constexpr ArmPose kForwards = {-1.45, 0.1, 0, 1.4, 0, 0, 0};
constexpr ArmPose kAtMouth = {-1.1, 0.2, -0.15, -0.6, 0, 0, 0};
constexpr ArmPose kKissThrown = {-1.1, 0.45, 0.2, 0.7, 0, 0, 0};
constexpr ArmPose kHandsApart = {-0.5, 0.1, 0.15, 0.1, 0, 0, 0};
constexpr ArmPose kHandsTogether = {-0.5, 0.1, -0.12, 0.1, 0, 0, 0};
constexpr ArmPose kHighFive = {-1.4, 0.2, 0, 0, 0, 0, 0};
constexpr ArmPose kOpenArms = {-1.1, 0.6, 0.2, 1.1, 0, 0, 0};
constexpr ArmPose kHug = {-1.1, 0.25, -0.3, 0.8, 0, 0, 0};
constexpr ArmPose kHeartHalf = {-1.7, 0.2, -0.3, 0.1, 0, 0, 0};
constexpr ArmPose kSmallHeart = {-0.9, 0.15, -0.1, -0.4, 0, 0, 0};
constexpr ArmPose kCrossOver = {-1.15, 0.15, -0.55, 0.1, 0, 0, 0};
constexpr ArmPose kCrossUnder = {-0.6, 0.15, -0.5, 0.2, 0, 0, 0};
constexpr ArmPose kBeamUpright = {-1.2, 0.2, 0, -0.2, 0, 0, 0};
constexpr ArmPose kBeamLevel = {-0.45, 0.2, -0.6, 0.15, 0, 0, 0};
constexpr ArmPose kChestWaveOut = {-0.8, 0.25, 0.35, -0.6, 0, 0, 0};
constexpr ArmPose kChestWaveIn = {-0.8, 0.25, -0.15, -0.6, 0, 0, 0};
constexpr ArmPose kHighWaveOut = {-2.2, 0.3, -0.35, 0.5, 0, 0, 0};
constexpr ArmPose kHighWaveIn = {-2.2, 0.3, 0.35, 0.5, 0, 0, 0};
constexpr ArmPose kHandshake = {-0.5, 0.1, 0, 0.35, 0, 0, 0};
constexpr ArmPose kOnHeart = {-0.6, 0.25, -0.7, -0.6, 0, 0, 0};

constexpr ArmKey kTwoHandKiss[] = {
    {1.2, &kAtMouth, &kAtMouth}, {0.8, &kKissThrown, &kKissThrown}, {1.4, nullptr, nullptr}};
constexpr ArmKey kLeftKiss[] = {
    {1.2, &kAtMouth, nullptr}, {0.8, &kKissThrown, nullptr}, {1.4, nullptr, nullptr}};
constexpr ArmKey kRightKiss[] = {
    {1.2, nullptr, &kAtMouth}, {0.8, nullptr, &kKissThrown}, {1.4, nullptr, nullptr}};
constexpr ArmKey kArmsSideways[] = {{1.8, &kSideways, &kSideways}};
constexpr ArmKey kClap[] = {
    {1.0, &kHandsApart, &kHandsApart},  {0.25, &kHandsTogether, &kHandsTogether},
    {0.25, &kHandsApart, &kHandsApart}, {0.25, &kHandsTogether, &kHandsTogether},
    {0.25, &kHandsApart, &kHandsApart}, {0.25, &kHandsTogether, &kHandsTogether},
    {0.25, &kHandsApart, &kHandsApart}, {1.2, nullptr, nullptr}};
constexpr ArmKey kHighFiveKeys[] = {{1.4, nullptr, &kHighFive}};
constexpr ArmKey kHugKeys[] = {{1.4, &kOpenArms, &kOpenArms}, {1.0, &kHug, &kHug}};
constexpr ArmKey kHeart[] = {{1.8, &kHeartHalf, &kHeartHalf}};
constexpr ArmKey kRightHeart[] = {{1.4, nullptr, &kSmallHeart}};
constexpr ArmKey kCross[] = {{1.4, &kCrossUnder, &kCrossOver}};
constexpr ArmKey kRightForwards[] = {{1.4, nullptr, &kForwards}};
constexpr ArmKey kBeam[] = {{1.4, &kBeamLevel, &kBeamUpright}};
constexpr ArmKey kChestWave[] = {{1.0, nullptr, &kChestWaveOut},  {0.35, nullptr, &kChestWaveIn},
                                 {0.35, nullptr, &kChestWaveOut}, {0.35, nullptr, &kChestWaveIn},
                                 {0.35, nullptr, &kChestWaveOut}, {0.35, nullptr, &kChestWaveIn},
                                 {1.3, nullptr, nullptr}};
constexpr ArmKey kHighWave[] = {{1.2, nullptr, &kHighWaveOut}, {0.4, nullptr, &kHighWaveIn},
                                {0.4, nullptr, &kHighWaveOut}, {0.4, nullptr, &kHighWaveIn},
                                {0.4, nullptr, &kHighWaveOut}, {1.4, nullptr, nullptr}};
constexpr ArmKey kHandshakeKeys[] = {{1.2, nullptr, &kHandshake}};
constexpr ArmKey kHandOnHeart[] = {{1.4, nullptr, &kOnHeart}};

constexpr ArmSequence kActions[] = {{11, kTwoHandKiss},
                                    {12, kLeftKiss},
                                    {13, kRightKiss},
                                    {15, kArmsSideways, true},
                                    {17, kClap},
                                    {18, kHighFiveKeys, true},
                                    {19, kHugKeys, true},
                                    {20, kHeart, true},
                                    {21, kRightHeart, true},
                                    {22, kCross, true},
                                    {23, kRightForwards, true},
                                    {24, kBeam, true},
                                    {25, kChestWave},
                                    {26, kHighWave},
                                    {27, kHandshakeKeys, true},
                                    {33, kHandOnHeart, true}};

// turn_back_wave, box wins, one without a name, push.
constexpr int kUnplayed[] = {1, 28, 29, 30, 34, 36};

}  // namespace

double Mirrored(const ArmPose& pose, std::size_t joint) {
  constexpr std::array<double, kArmJoints> kSign = {1, -1, -1, 1, -1, 1, -1};
  return kSign[joint] * pose[joint];
}

const ArmSequence* FindArmSequence(int id) {
  const auto* found = std::find_if(std::begin(kActions), std::end(kActions),
                                   [id](const auto& a) { return a.id == id; });
  return found == std::end(kActions) ? nullptr : found;
}

bool IsUnplayedArmAction(int id) {
  return std::find(std::begin(kUnplayed), std::end(kUnplayed), id) != std::end(kUnplayed);
}

}  // namespace understudy::motion
