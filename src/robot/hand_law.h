// How hands talk and obey, by make: what is neither in their models nor among their figures.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "robot/robot_spec.h"

namespace understudy::robot {

struct HandLaw {
  // Of the messages: HandCmd_ and HandState_ of hg, with a twin on rt/lf; MotorCmds_ and
  // MotorStates_ of go; or inspire_hand_ctrl, _state and _touch.
  enum class Messages : std::uint8_t { kHand, kMotors, kRegisters };
  // Motors follow q, dq, tau, kp and kd. Or q is a goal, to which the hand's own controllers lead
  // each motor at its knee_speed with hold_kp and hold_kd, or at dq of the command. Of registers
  // each of goal, speed dq and force tau is kept until a command has another one: kNoPosition,
  // kNoVelocity and a tau below 0 are none.
  enum class Follows : std::uint8_t { kMotors, kGoals, kGoalsAtSpeed, kRegisters };

  std::string_view name;  // robot.hands[].law
  Messages messages;
  Follows follows;
  bool watched;       // kMotors messages: motors lock when commands stop, as if each had the bit
  bool starts;        // before the first command it goes to q 0
  bool shows_motion;  // kMotors messages: states have dq and tau_est
  bool counts_lost;   // kMotors messages: states have lost
};

// Sources: docs/hands.md.
inline constexpr HandLaw kHandLaws[] = {
    {.name = "dex3",
     .messages = HandLaw::Messages::kHand,
     .follows = HandLaw::Follows::kMotors,
     .watched = false,
     .starts = false,
     .shows_motion = true,
     .counts_lost = false},
    {.name = "dex1",
     .messages = HandLaw::Messages::kMotors,
     .follows = HandLaw::Follows::kMotors,
     .watched = true,
     .starts = false,
     .shows_motion = true,
     .counts_lost = false},
    {.name = "inspire",
     .messages = HandLaw::Messages::kMotors,
     .follows = HandLaw::Follows::kGoals,
     .watched = false,
     .starts = false,
     .shows_motion = false,
     .counts_lost = true},
    {.name = "brainco",
     .messages = HandLaw::Messages::kMotors,
     .follows = HandLaw::Follows::kGoalsAtSpeed,
     .watched = false,
     .starts = true,
     .shows_motion = true,
     .counts_lost = false},
    {.name = "inspire_ftp",
     .messages = HandLaw::Messages::kRegisters,
     .follows = HandLaw::Follows::kRegisters,
     .watched = false,
     .starts = false,
     .shows_motion = false,
     .counts_lost = false},
};

inline std::vector<std::string> HandLawNames() {
  std::vector<std::string> names;
  for (const HandLaw& law : kHandLaws) names.emplace_back(law.name);
  return names;
}

// Returns the law of a hand whose robot.hands[].law is valid.
inline const HandLaw& LawOf(const HandSpec& spec) {
  return *std::ranges::find(kHandLaws, std::string_view(spec.law), &HandLaw::name);
}

// Returns a topic of a hand: the word stands where its spec has a `*`, or behind a slash: "cmd" and
// "state" of most hands, "ctrl", "state" and "touch" of those with registers.
inline std::string HandTopic(const HandSpec& spec, std::string_view word) {
  const std::size_t at = spec.topic.find('*');
  if (at == std::string::npos) return "rt/" + spec.topic + "/" + std::string(word);
  return "rt/" + spec.topic.substr(0, at) + std::string(word) + spec.topic.substr(at + 1);
}

// Returns its topic of commands.
inline std::string HandCommandTopic(const HandSpec& spec) {
  return HandTopic(spec, LawOf(spec).messages == HandLaw::Messages::kRegisters ? "ctrl" : "cmd");
}

// Returns the hand that a joint or site of a hand's spec is part of: "left" or "right" where its
// name begins so, else the name of the spec. Two hands may share a spec, since they share messages.
inline std::string HandNameOf(const HandSpec& spec, std::string_view element) {
  for (const char* side : {"left", "right"}) {
    if (element.starts_with(std::string(side) + "_")) return side;
  }
  return spec.name;
}

// At most so many are there.
inline constexpr std::size_t kMostHandNames = 2 * kMostHands;

// Returns the names of a robot's hands in the order of the alphabet: left before right.
inline std::vector<std::string> HandNames(const RobotSpec& spec) {
  std::vector<std::string> names;
  for (const HandSpec& hand : spec.hands) {
    for (const MotorSpec& motor : hand.motors) names.push_back(HandNameOf(hand, motor.joint));
    for (const PadSpec& pad : hand.pads) {
      if (!pad.site.empty()) names.push_back(HandNameOf(hand, pad.site));
    }
  }
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

inline std::size_t CellsOf(const PadSpec& pad) {
  return static_cast<std::size_t>(pad.rows) * static_cast<std::size_t>(pad.columns);
}
// Returns how many cells all pads of a hand have.
inline std::size_t CellsOf(const HandSpec& spec) {
  std::size_t cells = 0;
  for (const PadSpec& pad : spec.pads) cells += CellsOf(pad);
  return cells;
}

// Returns how many motors its messages have.
inline std::size_t SlotsOf(const HandSpec& spec) {
  return spec.slots == 0 ? spec.motors.size() : static_cast<std::size_t>(spec.slots);
}

}  // namespace understudy::robot
