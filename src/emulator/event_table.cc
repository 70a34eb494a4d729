#include "emulator/event_table.h"

#include "authority/command_gate.h"
#include "authority/unheeded.h"
#include "base/printed.h"
#include "motion/protection.h"
#include "robot/command_topics.h"
#include "robot/fault.h"
#include "robot/refusal_text.h"
#include "robot/remote_keys.h"
#include "services/service_port.h"
#include "wire/who_serves.h"

namespace understudy::emulator {
namespace {

using enum EventFieldType;
using enum EventLevel;
using enum EventPace;

std::string What(const Event& event) { return event.text.data(); }

// "lying (1004)": a state of a motion service with the vendor's id.
std::string StateText(const std::string& name, double id) { return name + Printed(" (%.0f)", id); }

// What helps a program whose types differ in no more than their definition.
constexpr const char* kOtherCyclone =
    "; in Python `pip install cyclonedds==0.10.2` helps, as the vendor's SDK needs it, else build "
    "it with the vendor's IDL";

bool On(const Event& event) { return event.numbers[0] != 0; }

std::string Plural(double count, const std::string& what) {
  return std::to_string(static_cast<std::int64_t>(count)) + " " + what + (count == 1 ? "" : "s");
}

std::string Times(std::uint64_t count) {
  return count == 1 ? "" : " (" + std::to_string(count) + " times)";
}

std::string Keys(double bits) { return robot::RemoteKeyNames(static_cast<std::uint16_t>(bits)); }

robot::Refusal ReasonOf(const Event& event) {
  return static_cast<robot::Refusal>(event.numbers[0]);
}

const robot::FaultKind& FaultOf(const Event& event) {
  return robot::FaultKinds()[static_cast<std::size_t>(event.numbers[0])];
}

const motion::DangerRow& DangerOf(const Event& event) {
  return motion::Dangers()[static_cast<std::size_t>(event.numbers[0])];
}

std::string Amount(const robot::FaultKind& kind, double by) {
  if (!kind.has_magnitude()) return "";
  return Printed(" by %g", by) + (kind.unit.empty() ? "" : " ") + std::string(kind.unit);
}

bool IsOfHand(const Event& event) { return !robot::IsBodyCommandTopic(event.text.data()); }

// What brings the commands of the topic that `text` names.
std::string MessageOf(const Event& event) {
  if (What(event) == robot::kCommandTopicNames[robot::kLowCmdTopic]) return "LowCmd";
  return (IsOfHand(event) ? "HandCmd of " : "LowCmd of ") + What(event);
}

std::string SayRefusal(const std::string& verb, robot::Refusal reason, const Event& event,
                       std::uint64_t count) {
  return verb + " " + std::to_string(count) + " " + MessageOf(event) + " (" +
         std::string(robot::Name(reason)) + "): " +
         std::string(IsOfHand(event) ? robot::ExplainForHand(reason) : robot::Explain(reason));
}

std::string SayProtection(const Event& event, std::uint64_t) {
  const motion::DangerRow& danger = DangerOf(event);
  const std::string where = What(event).empty() ? "" : " of " + What(event);
  std::string text = "protection: " + std::string(danger.name);
  if (event.numbers[1] == 0) return text + where + " is within its limit again";
  if (!danger.unit.empty()) text += Printed(" %.2f ", event.numbers[2]) + std::string(danger.unit);
  if (danger.below) text += Printed(" %.2f", event.numbers[2]);
  constexpr std::array<std::string_view, 5> kDoes = {
      "", "", "; the robot stops", "; the robot lies down, if it can", "; the motors damp"};
  return text + where + std::string(kDoes[static_cast<std::size_t>(event.numbers[3])]);
}

std::string SayCallRefusal(const Event& event, std::uint64_t) {
  const auto reason = static_cast<services::CallRefusal>(event.numbers[0]);
  const bool answered = event.numbers[1] != services::Call::kNoCode;
  std::string text = "refused " + Plural(event.numbers[3], "call") + " of " + What(event) + " (" +
                     std::string(services::Name(reason)) +
                     "): " + std::string(services::Explain(reason));
  if (reason == services::CallRefusal::kState || reason == services::CallRefusal::kIgnored)
    text += ", " + Printed("%.0f", event.numbers[2]);
  return text + (answered ? "; code " + Printed("%.0f", event.numbers[1]) : "; not answered");
}

std::string SayUnserved(const Event& event, std::uint64_t) {
  const std::string who =
      event.numbers[1] == 0 ? "a program" : Printed("process %.0f", event.numbers[1]);
  return who + (On(event) ? " waits for " : " writes ") + What(event) + ", which nobody here " +
         (On(event) ? "sends; it would come from " : "reads; it is for ") +
         wire::WhoWouldSend(What(event));
}

std::string SayTimeout(const Event& event, std::uint64_t count) {
  return MessageOf(event) +
         (IsOfHand(event) ? " stopped: watched motors lock until the next one"
                          : " stopped: motors are damping until the next one") +
         Times(count);
}

std::string SayUnheeded(const Event& event, std::uint64_t) {
  const auto reason = static_cast<authority::Unheeded::Reason>(event.numbers[0]);
  const bool sticks = event.numbers[1] == 0;
  const std::string who = sticks ? "the sticks" : Keys(event.numbers[1]);
  const double wish = event.numbers[2];
  std::string text;
  switch (reason) {
    case authority::Unheeded::Reason::kNoMotionService:
      text = who + ": no motion service is on that could obey";
      if (!What(event).empty()) {
        text += "; `understudy ctl service call motion_switcher 1002 '{\"name\": \"" + What(event) +
                "\"}'` switches it on";
      }
      break;
    case authority::Unheeded::Reason::kState:
      text = who + (sticks ? " have no effect in " : " has no effect in ") +
             StateText(What(event), event.numbers[3]);
      break;
    case authority::Unheeded::Reason::kNotSimulated:
      text = who +
             (sticks      ? " ask the robot to walk"
              : wish >= 0 ? " asks for state " + Printed("%.0f", wish) + " of the real robot"
                          : " asks for a motion") +
             ", which is not modelled: the robot stays in " +
             StateText(What(event), event.numbers[3]);
      break;
  }
  return text;
}

constexpr EventRow Row(EventKind kind, std::string_view name, EventLevel level, EventPace pace,
                       const std::array<EventField, 5>& fields,
                       std::string (*say)(const Event& event, std::uint64_t count),
                       std::string_view when) {
  return {kind, name, level, pace, fields, say, when};
}

constexpr EventRow WorldRow(EventKind kind, std::string_view name, EventLevel level, EventPace pace,
                            const std::array<EventField, 5>& fields,
                            std::string (*say)(const Event& event, std::uint64_t count),
                            std::string_view when) {
  return {kind, name, level, pace, fields, say, when, /*of_world=*/true};
}

constexpr std::array<EventRow, kEventKinds> kRows = {{
    Row(
        EventKind::kRefused, "refused", kWarning, kEverLess,
        {{{"reason", kReason}, {"topic", kText}}},
        [](const Event& e, std::uint64_t n) { return SayRefusal("refused", ReasonOf(e), e, n); },
        "a command is refused"),
    Row(
        EventKind::kTolerated, "tolerated", kInfo, kPeriod,
        {{{"reason", kReason}, {"topic", kText}}},
        [](const Event& e, std::uint64_t n) { return SayRefusal("tolerated", ReasonOf(e), e, n); },
        "a lenient gate takes a command whose form is wrong"),
    Row(
        EventKind::kLostCommands, "lost_commands", kWarning, kPeriod,
        {{{"commands", kSum}, {"topic", kText}}},
        [](const Event& e, std::uint64_t) {
          return SayRefusal("refused", robot::Refusal::kLost, e,
                            static_cast<std::uint64_t>(e.numbers[0]));
        },
        "commands are replaced by newer ones before they are read, or lost by the bus"),
    Row(
        EventKind::kUnmatched, "unmatched", kWarning, kPeriod, {{{"writer", kText}}},
        [](const Event& e, std::uint64_t) {
          const bool other = What(e).find("another definition") != std::string::npos;
          return "nothing arrives on " + What(e) + (other ? kOtherCyclone : "");
        },
        "somebody writes a topic of the robot with another type or quality of service"),
    Row(EventKind::kUnserved, "unserved", kWarning, kEach,
        {{{"reads", kBool}, {"process", kInteger}, {"topic", kText}}}, SayUnserved,
        "a program reads a topic that nobody writes, or writes one of robots that nobody reads"),
    Row(EventKind::kTimeout, "timeout", kWarning, kPeriod, {{{"topic", kText}}}, SayTimeout,
        "commands stop"),
    Row(
        EventKind::kFollowing, "following", kInfo, kEach, {{{"topic", kText}}},
        [](const Event& e, std::uint64_t) { return "the motors follow " + MessageOf(e); },
        "the first command of a topic is taken"),
    Row(
        EventKind::kFirstCommand, "first_command", kSilent, kEach,
        {{{"jump", kNumber}, {"joint", kText}}},
        [](const Event& e, std::uint64_t) {
          return "the first LowCmd that asks for angles is " + Printed("%.3f", e.numbers[0]) +
                 " rad off at " + What(e);
        },
        "the first command of `rt/lowcmd` that asks a joint for an angle is taken; `jump` is the "
        "largest difference from a joint's own in `rt/lowstate` [rad], `joint` is the one"),
    Row(
        EventKind::kUnheld, "unheld", kWarning, kEach, {{{"joints", kInteger}, {"which", kText}}},
        [](const Event& e, std::uint64_t) {
          const double more = e.numbers[0] - kMostNamed;
          return What(e) + (more > 0 ? Printed(" and %.0f more", more) : "") +
                 ": kp and tau of their commands are 0, so nothing holds them";
        },
        "the first command of a topic holds some joints and leaves others without gains and "
        "torque"),
    Row(
        EventKind::kGate, "gate", kSilent, kEach, {{{"state", kGate}}},
        [](const Event& e, std::uint64_t) {
          return "gate: " +
                 std::string(authority::Name(static_cast<authority::GateState>(e.numbers[0])));
        },
        "the gate of rt/lowcmd changes its state, and at the start"),
    Row(
        EventKind::kMotionService, "motion_service", kInfo, kEach, {{{"service", kText}}},
        [](const Event& e, std::uint64_t) {
          return e.text[0] == '\0' ? "no motion service is on: motors follow rt/lowcmd"
                                   : "motion service " + What(e) + " moves the motors";
        },
        "another motion service is on, or none, and at the start"),
    Row(
        EventKind::kMotion, "motion", kSilent, kEach,
        {{{"state", kInteger}, {"mode", kInteger}, {"name", kText}}},
        [](const Event& e, std::uint64_t) { return StateText(What(e), e.numbers[0]); },
        "the motion service changes its state"),
    Row(EventKind::kUnheeded, "unheeded", kInfo, kEach,
        {{{"reason", kWish},
          {"keys", kKeys},
          {"wish", kInteger},
          {"state", kInteger},
          {"name", kText}}},
        SayUnheeded,
        "the remote controller asks for what the robot does not do: `no_motion_service` is on, not "
        "in this `state`, or `not_simulated`; `wish` is the state that is asked for, or -1"),
    Row(
        EventKind::kRemote, "remote", kSilent, kEach, {{{"keys", kKeys}}},
        [](const Event& e, std::uint64_t) { return On(e) ? Keys(e.numbers[0]) : "keys released"; },
        "keys of the remote controller go down or up"),
    Row(
        EventKind::kRequest, "request", kSilent, kEach, {},
        [](const Event& e, std::uint64_t) { return e.request.row ? Describe(e.request) : ""; },
        "somebody makes a request that has no event of its own; reported under the name of [the "
        "request](reference/requests.md), such as `push`"),
    Row(
        EventKind::kCrane, "crane", kSilent, kEach, {{{"attached", kBool}}},
        [](const Event& e, std::uint64_t) -> std::string {
          return On(e) ? "hangs from the crane" : "released from the crane";
        },
        "the robot is attached to the crane or released"),
    Row(
        EventKind::kClamp, "clamp", kSilent, kEach, {{{"on", kBool}}},
        [](const Event& e, std::uint64_t) -> std::string {
          return On(e) ? "clamped" : "unclamped";
        },
        "the clamp closes or opens"),
    Row(
        EventKind::kSetting, "setting", kInfo, kEach,
        {{{"value", kNumber}, {"before", kNumber}, {"setting", kText}}},
        [](const Event& e, std::uint64_t) { return "set " + What(e); },
        "a setting changes while the robot runs; of words the first is 0"),
    Row(
        EventKind::kFault, "fault", kInfo, kEach,
        {{{"fault", kFault}, {"on", kBool}, {"by", kNumber}, {"component", kText}}},
        [](const Event& e, std::uint64_t) {
          const robot::FaultKind& kind = FaultOf(e);
          const std::string name(kind.name);
          return e.numbers[1] != 0 ? What(e) + " is " + name + Amount(kind, e.numbers[2])
                                   : What(e) + " is no longer " + name;
        },
        "something is wrong with a component of the robot, or no longer"),
    Row(
        EventKind::kMotorHeat, "motor_heat", kWarning, kEach,
        {{{"state", kInteger}, {"winding", kNumber}, {"joint", kText}}},
        [](const Event& e, std::uint64_t) {
          return What(e) + ": the winding is at " + Printed("%.0f °C", e.numbers[1]) +
                 (e.numbers[0] == 2   ? ", and the motor gives no torque until it has cooled"
                  : e.numbers[0] == 1 ? ", and the motor gives less torque"
                                      : ", and the motor gives all of its torque again");
        },
        "a motor becomes so hot that it gives less torque (1) or none (2), or cool again (0)"),
    Row(
        EventKind::kPower, "power", kInfo, kEach, {{{"state", kText}}},
        [](const Event& e, std::uint64_t) { return "power: " + What(e); },
        "the robot is switched on and boots (`booting`), has booted (`on`) or is off (`off`)"),
    Row(
        EventKind::kCutOff, "cut_off", kError, kEach, {{{"reason", kInteger}}},
        [](const Event& e, std::uint64_t) -> std::string {
          constexpr std::array<std::string_view, 4> kReasons = {
              "is on again",
              "has cut off after too much current; `power on` switches the robot on again",
              "has cut off, as a cell had too little voltage; `power on` switches the robot on "
              "again",
              "is empty and has cut off"};
          return "the battery " + std::string(kReasons[static_cast<std::size_t>(e.numbers[0])]);
        },
        "the battery cuts off its bus for current (1), voltage (2) or being empty (3), or is on "
        "again (0)"),
    Row(
        EventKind::kLowBattery, "low_battery", kWarning, kEach, {{{"charge", kNumber}}},
        [](const Event& e, std::uint64_t) {
          return "the battery is down to " + Printed("%.0f %%", 100 * e.numbers[0]) +
                 " of its charge";
        },
        "the charge falls below robot.battery.low_soc, the first time"),
    Row(EventKind::kProtection, "protection", kWarning, kEach,
        {{{"danger", kDanger},
          {"on", kBool},
          {"value", kNumber},
          {"does", kProtects},
          {"joint", kText}}},
        SayProtection,
        "the motion service protects the robot from a danger of [robot.motion.protection]"
        "(reference/config.md), or no longer"),
    WorldRow(
        EventKind::kPause, "pause", kInfo, kEach, {{{"on", kBool}}},
        [](const Event& e, std::uint64_t) {
          return (On(e) ? "paused at " : "resumed at ") + Printed("%.3f", e.time) + " s";
        },
        "the robot is paused or resumed"),
    WorldRow(
        EventKind::kSpeed, "speed", kInfo, kEach, {{{"speed", kNumber}}},
        [](const Event& e, std::uint64_t) {
          return "speed " + (On(e) ? Printed("%g", e.numbers[0]) : "as fast as possible");
        },
        "another speed is asked for"),
    WorldRow(
        EventKind::kScript, "script", kSilent, kEach, {{{"event", kInteger}, {"where", kText}}},
        [](const Event& e, std::uint64_t) { return What(e); }, "a script's request is given"),
    WorldRow(
        EventKind::kScriptRefused, "script_refused", kWarning, kPeriod, {{{"why", kText}}},
        [](const Event& e, std::uint64_t n) { return "script: " + What(e) + Times(n); },
        "a script's request is refused"),
    WorldRow(
        EventKind::kScriptWait, "script_wait", kInfo, kEach,
        {{{"event", kInteger}, {"seconds", kNumber}, {"came", kBool}, {"condition", kText}}},
        [](const Event& e, std::uint64_t) {
          const std::string seconds = Printed("%.3f s", e.numbers[1]);
          return e.numbers[2] != 0
                     ? "script: waited " + seconds + " for '" + What(e) + "'"
                     : "script: timed out after " + seconds + " waiting for '" + What(e) + "'";
        },
        "what a script waited for has come, or the script waits no longer"),
    WorldRow(
        EventKind::kDivergence, "divergence", kError, kPeriod, {},
        [](const Event& e, std::uint64_t n) {
          return "the physics diverged at " + Printed("%.3f", e.time) + " s" + Times(n);
        },
        "the physics diverges"),
    Row(
        EventKind::kSilence, "silence", kWarning, kEach, {{{"on", kBool}}},
        [](const Event& e, std::uint64_t) -> std::string {
          return On(e) ? "sends nothing, because another robot is on this network" : "sends again";
        },
        "the robot stops publishing beside another robot, or publishes again"),
    Row(
        EventKind::kWriters, "writers", kWarning, kPeriod, {{{"writers", kInteger}}},
        [](const Event& e, std::uint64_t) {
          return Printed("%.0f", e.numbers[0]) +
                 " programs write rt/lowcmd; the robot follows whichever wrote last";
        },
        "two programs or more write rt/lowcmd"),
    Row(
        EventKind::kUnusedSlot, "unused_slot", kWarning, kEach, {},
        [](const Event&, std::uint64_t) -> std::string {
          return "a LowCmd commands slots without a motor, each differently; the robot ignores "
                 "them. Does the program use this robot's motor order?";
        },
        "a LowCmd has gains or torque in slots without a motor, and not the same in all of them, "
        "the first time"),
    Row(
        EventKind::kUnsetHead, "unset_head", kInfo, kEach, {},
        [](const Event&, std::uint64_t) -> std::string {
          return "LowCmd comes without head and level_flag; it is taken here, but nobody has shown "
                 "that a real robot takes it";
        },
        "a LowCmd comes without head and level_flag, the first time"),
    Row(
        EventKind::kWriteFailure, "write_failure", kError, kPeriod, {{{"messages", kSum}}},
        [](const Event& e, std::uint64_t) {
          return Plural(e.numbers[0], "message") + " could not be sent";
        },
        "the bus does not take messages"),
    WorldRow(
        EventKind::kOverrun, "overrun", kSilent, kPeriod, {{{"worst", kWorst}}},
        [](const Event& e, std::uint64_t n) {
          return Plural(static_cast<double>(n), "tick") + " began late, the worst by " +
                 Printed("%.1f", e.numbers[0] * 1e3) + " ms";
        },
        "a tick begins more than one period late"),
    WorldRow(
        EventKind::kStall, "stall", kWarning, kPeriod, {{{"seconds", kSum}}},
        [](const Event& e, std::uint64_t) {
          return "simulated time has fallen " + Printed("%.1f", e.numbers[0]) +
                 " s behind wall time and does not catch up";
        },
        "a tick begins so late that it is not made up for"),
    Row(
        EventKind::kCall, "call", kSilent, kPeriod,
        {{{"api", kCause}, {"code", kCause}, {"service", kText}}},
        [](const Event& e, std::uint64_t n) {
          const auto api = static_cast<std::int64_t>(e.numbers[0]);
          const auto code = static_cast<std::int64_t>(e.numbers[1]);
          return What(e) + " " + std::to_string(api) + " answers " + std::to_string(code) +
                 Times(n);
        },
        "a service is called; calls about leases only if they are refused"),
    Row(EventKind::kCallRefused, "call_refused", kWarning, kEverLess,
        {{{"reason", kCallReason},
          {"code", kInteger},
          {"state", kInteger},
          {"calls", kSum},
          {"call", kText}}},
        SayCallRefusal, "a call of a service is refused or ignored"),
    WorldRow(
        EventKind::kProgramStart, "program_start", kInfo, kEach, {{{"command", kText}}},
        [](const Event& e, std::uint64_t) { return "starting " + What(e); },
        "a rehearsal starts the program under test"),
    WorldRow(
        EventKind::kProgramEnd, "program_end", kInfo, kEach, {{{"code", kInteger}}},
        [](const Event& e, std::uint64_t) {
          return "the program ended with exit code " + Printed("%.0f", e.numbers[0]);
        },
        "that program has ended: its exit code, 128 + n if signal n ended it"),
    WorldRow(
        EventKind::kProgramPrints, "program_prints", kSilent, kPeriod, {{{"text", kText}}},
        [](const Event& e, std::uint64_t n) {
          return "the program prints \"" + What(e) + "\"" + Times(n);
        },
        "a line of the program has a text for which a script or an expectation looks"),
    Row(
        EventKind::kRecording, "recording", kInfo, kEach, {{{"on", kBool}, {"file", kText}}},
        [](const Event& e, std::uint64_t) {
          return (On(e) ? "recording to " : "finished the recording ") + What(e);
        },
        "a recording begins or is finished because of a request"),
    Row(
        EventKind::kRecordingFailed, "recording_failed", kError, kEach, {{{"why", kText}}},
        [](const Event& e, std::uint64_t) { return "recording: " + What(e); },
        "a recording that was asked for cannot be made"),
    WorldRow(
        EventKind::kLost, "lost", kWarning, kPeriod, {{{"events", kSum}}},
        [](const Event& e, std::uint64_t) {
          return Plural(e.numbers[0], "event") + " came too fast to be reported";
        },
        "events come faster than they can be reported"),
}};

static_assert([] {
  for (std::size_t i = 0; i < kEventKinds; ++i) {
    if (kRows[i].kind != static_cast<EventKind>(i)) return false;
  }
  return true;
}());

}  // namespace

std::span<const EventRow, kEventKinds> EventTable() { return kRows; }

const EventRow& RowOf(EventKind kind) { return kRows[static_cast<std::size_t>(kind)]; }

}  // namespace understudy::emulator
