#include "motion/chord_effects.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

#include "authority/chord.h"
#include "motion/humanoid/fsm.h"
#include "motion/quadruped/goal_facts.h"
#include "motion/quadruped/states.h"
#include "robot/arm_actions.h"

namespace understudy::motion {
namespace {

using authority::MotionVerdict;
namespace goal = authority::goal;

// States of a G1 that have no stance of ours, or whose stance depends on the waist: the words of
// its list (docs/dev/sources.md#g1-states), 503 and 812 as its picture of transitions has them.
constexpr std::pair<int, std::string_view> kNames[] = {
    {500, "main control, waist locked"},
    {501, "main control, waist free"},
    {503, "dance"},
    {702, "stand up from lying"},
    {801, "run"},
    {802, "run, waist free"},
    {812, "climb"},
};

std::string NameOfStance(const robot::HumanoidMotionSpec& spec, int id) {
  const HumanoidStance stance = StanceOf(spec, id);
  if (stance != HumanoidStance::kUnplayed && stance != HumanoidStance::kNone) {
    return std::string(Name(stance));
  }
  const auto* const known = std::ranges::find(kNames, id, &std::pair<int, std::string_view>::first);
  return known != std::end(kNames) ? std::string(known->second) : "state " + std::to_string(id);
}

std::vector<int> StancesOf(const robot::HumanoidMotionSpec& spec) {
  std::vector<int> ids = {robot::kZeroTorqueId, robot::kDampingId, spec.lock_stand,
                          spec.squat,           spec.sit,          spec.balanced_squat,
                          spec.arms_balance};
  ids.insert(ids.end(), spec.balance.begin(), spec.balance.end());
  ids.insert(ids.end(), spec.walk.begin(), spec.walk.end());
  std::vector<int> once;
  for (const int id : ids) {
    if (id >= 0 && std::ranges::find(once, id) == once.end()) once.push_back(id);
  }
  return once;
}

// Each id once: of the states that share one, the one that lasts.
std::vector<QuadrupedState> QuadrupedStatesOf(bool wheeled) {
  std::vector<QuadrupedState> states;
  for (const bool lasting : {true, false}) {
    for (int i = 0; i <= static_cast<int>(QuadrupedState::kDriving); ++i) {
      const auto state = static_cast<QuadrupedState>(i);
      const QuadrupedStateRow& row = RowOf(state);
      const bool there =
          std::ranges::any_of(states, [&](QuadrupedState one) { return RowOf(one).id == row.id; });
      const bool gestures = kSits.Has(state) || kGestureStates.Has(state);
      if ((row.next == state) != lasting || there || (wheeled && gestures)) continue;
      states.push_back(state);
    }
  }
  return states;
}

// The state to which the goal leads; nullopt: it is not taken.
std::optional<QuadrupedState> Led(const authority::MotionGoal& wish, QuadrupedState from,
                                  const robot::RobotSpec& spec) {
  const bool wheeled = spec.kind == robot::RobotKind::kWheeled;
  const auto* const row = Find(QuadrupedTransitions(), wish.index(), from, [&](QuadrupedWhen when) {
    return when != QuadrupedWhen::kLegged || !wheeled;
  });
  if (row != nullptr && row->verdict == MotionVerdict::kTaken) return EndOf(row->to.value_or(from));
  const bool by_balance = spec.motion.quadruped.gestures_from_lock &&
                          from == QuadrupedState::kLocked && IsGesture(wish);
  return by_balance ? Led(wish, QuadrupedState::kBalance, spec) : std::nullopt;
}

std::vector<ChordEffect> OfQuadruped(const robot::RobotSpec& spec,
                                     const authority::MotionGoal& wish) {
  std::vector<ChordEffect> effects;
  for (const QuadrupedState from : QuadrupedStatesOf(spec.kind == robot::RobotKind::kWheeled)) {
    if (const auto to = Led(wish, from, spec)) effects.push_back({RowOf(from).id, RowOf(*to).id});
  }
  return effects;
}

// The state that the goal asks for; nullopt: none.
std::optional<int> WishedStance(const authority::MotionGoal& wish) {
  if (std::holds_alternative<goal::ZeroTorque>(wish)) return robot::kZeroTorqueId;
  if (std::holds_alternative<goal::Damp>(wish)) return robot::kDampingId;
  if (const auto* const fsm = std::get_if<goal::SetFsm>(&wish)) return fsm->id;
  return std::nullopt;
}

bool IsBalancedStance(HumanoidStance stance) {
  return stance == HumanoidStance::kBalanced || stance == HumanoidStance::kWalking;
}

std::vector<ChordEffect> OfHumanoid(const robot::HumanoidMotionSpec& spec,
                                    const authority::MotionGoal& wish) {
  const std::optional<int> wished = WishedStance(wish);
  std::vector<ChordEffect> effects;
  for (const int from : StancesOf(spec)) {
    if (wished && MayGo(spec, from, *wished, false) == MotionVerdict::kTaken) {
      effects.push_back({from, *wished});
    } else if (!wished && IsBalancedStance(StanceOf(spec, from))) {
      effects.push_back({from, from});  // of the arms
    }
  }
  return effects;
}

std::string NameOf(const robot::RobotSpec& spec, const robot::ChordSpec& chord) {
  const int id = static_cast<int>(chord.value);
  std::string name = chord.does;
  if (chord.does == "set_fsm") {
    name = NameOfStance(spec.motion.humanoid, id);
  } else if (chord.does == "arm_action") {
    const auto* const action = std::ranges::find(robot::kArmActions, id, &robot::ArmActionName::id);
    name = action == robot::kArmActions.end() ? "arm action " + std::to_string(id)
                                              : std::string(action->name);
  } else if (chord.value != 0) {
    name += " " + std::to_string(id);
  }
  std::ranges::replace(name, '_', ' ');
  return name;
}

bool Unplayed(const robot::RobotSpec& spec, const std::optional<authority::MotionGoal>& wish) {
  if (!wish || spec.kind != robot::RobotKind::kHumanoid) return false;
  const std::optional<int> wished = WishedStance(*wish);
  if (!wished) return false;
  const HumanoidStance stance = StanceOf(spec.motion.humanoid, *wished);
  return stance == HumanoidStance::kUnplayed || stance == HumanoidStance::kNone;
}

}  // namespace

std::vector<StateName> StateNames(const robot::RobotSpec& spec) {
  std::vector<StateName> names;
  if (robot::IsQuadruped(spec.kind)) {
    for (const QuadrupedState state : QuadrupedStatesOf(spec.kind == robot::RobotKind::kWheeled)) {
      names.push_back({RowOf(state).id, std::string(RowOf(state).name)});
    }
  } else if (spec.kind == robot::RobotKind::kHumanoid) {
    for (const int id : StancesOf(spec.motion.humanoid)) {
      names.push_back({id, NameOfStance(spec.motion.humanoid, id)});
    }
  }
  return names;
}

ChordEffects EffectsOf(const robot::RobotSpec& spec, const robot::ChordSpec& chord) {
  const authority::Chord decoded = authority::MakeChord(chord, "robot.remote.chords");
  ChordEffects effects{.name = NameOf(spec, chord), .simulated = !Unplayed(spec, decoded.goal)};
  if (!decoded.goal) return effects;
  if (robot::IsQuadruped(spec.kind)) effects.effects = OfQuadruped(spec, *decoded.goal);
  if (spec.kind == robot::RobotKind::kHumanoid) {
    effects.effects = OfHumanoid(spec.motion.humanoid, *decoded.goal);
  }
  std::erase_if(effects.effects, [&](const ChordEffect& effect) {
    return !chord.from.empty() && std::ranges::find(chord.from, effect.from) == chord.from.end();
  });
  return effects;
}

}  // namespace understudy::motion
