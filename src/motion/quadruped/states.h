// The states of a quadruped's motion service, and which goal leads from which to which.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "motion/transitions.h"

namespace understudy::motion {

enum class QuadrupedState : std::uint8_t {
  kDamped,
  kFolding,    // joints move to the crouch, towards a locked stand
  kRising,     // feet move down under the body, towards a locked stand
  kLocked,     // stands, joints locked
  kFoldingOn,  // as kFolding and kRising, towards a balanced stand
  kRisingOn,
  kLowering,   // feet move up to the crouch, towards lying
  kUnfolding,  // joints move to the lying pose
  kLying,      // joints locked
  kStanding,   // balanced, in a gait, until a command to move
  kBalance,    // what BalanceStand leads to
  kGesturing,
  kEndingGesture,  // puts the robot back on its feet
  kSittingDown,
  kSitting,
  kRisingSit,
  kPosing,
  kRecovering,
  kWalking,
  kDriving,  // on wheels
};

inline constexpr StateSet<QuadrupedState> kGestureStates{
    QuadrupedState::kGesturing, QuadrupedState::kEndingGesture, QuadrupedState::kRisingSit};
inline constexpr StateSet<QuadrupedState> kStands{QuadrupedState::kStanding,
                                                  QuadrupedState::kBalance};
inline constexpr StateSet<QuadrupedState> kSits{QuadrupedState::kSittingDown,
                                                QuadrupedState::kSitting};
// In which the stance leads the legs.
inline constexpr StateSet<QuadrupedState> kStanceStates{
    QuadrupedState::kStanding,    QuadrupedState::kBalance,       QuadrupedState::kPosing,
    QuadrupedState::kGesturing,   QuadrupedState::kEndingGesture, QuadrupedState::kRisingSit,
    QuadrupedState::kSittingDown, QuadrupedState::kSitting,       QuadrupedState::kDriving};
inline constexpr StateSet<QuadrupedState> kMovingStates{QuadrupedState::kWalking,
                                                        QuadrupedState::kDriving};

// On its way to a stand or a sit: what that allows waits for it.
inline constexpr StateSet<QuadrupedState> kOnTheWay{
    QuadrupedState::kFolding,    QuadrupedState::kRising,     QuadrupedState::kFoldingOn,
    QuadrupedState::kRisingOn,   QuadrupedState::kRecovering, QuadrupedState::kRisingSit,
    QuadrupedState::kSittingDown};

// What the robot reports of a state, and the state that follows once its behaviour is over. Of
// those that stand in a gait, walk or drive it reports what the gait's row says. Ids and modes are
// the vendor's (Go2 motion services V2.0; its page of the older firmware); that a robot rises in
// mode 3 was seen on a B2. Recovering is in neither list: the crouch and recoveryStand are assumed.
struct QuadrupedStateRow {
  QuadrupedState state;
  std::string_view name;   // for people
  int id, mode, progress;  // of robot::MotionState
  QuadrupedState next;     // the same: it lasts. kStanding: the stand that it came from
};
const QuadrupedStateRow& RowOf(QuadrupedState state);
// Returns the state that lasts to which this one leads by itself.
QuadrupedState EndOf(QuadrupedState state);

// When a row counts.
enum class QuadrupedWhen : std::uint8_t {
  kAlways,
  kUpright,  // enough for the legs alone
  kLegged,   // has no wheels
};

// By MotionGoal::index(). A row that leads to kStanding leads back to BalanceStand's stand where
// the robot came from that. What is legal where is assumed where it is not the vendor's word
// (docs/reference/fidelity.md): the vendor's graph was not found.
using QuadrupedTransition = Transition<std::size_t, QuadrupedState, QuadrupedWhen>;
std::span<const QuadrupedTransition> QuadrupedTransitions();

}  // namespace understudy::motion
