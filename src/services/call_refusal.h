// The reasons for which a call of a service has no effect.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace understudy::services {

enum class CallRefusal : std::uint8_t {
  kNone,
  kUnknownApi,    // the service has no such api
  kLease,         // another client holds the lease, or this one's is over
  kParameter,     // not JSON, or a field is missing, of another type, out of range or too long
  kState,         // the motion service does not do it in its present state
  kIgnored,       // answered as taken, and without effect as on the real robot
  kGoal,          // the motion service has no such state, action or number
  kName,          // the robot has no program, motion service or word of that name
  kProtected,     // the program cannot be switched
  kNotSimulated,  // the real robot has it
  kFailed,        // a bug: carrying it out threw
  kCode,          // for a reason of the api's own, which its code says
  kNotServed,     // the program that serves it, or every motion service, is off
  kUndecoded,     // not a request, or longer than any that is decoded
  kTooMany,       // more came than wait: the oldest are dropped
  kUnmatched,     // counts writers, of another type or quality of service than the topic's
  kCount,
};

inline constexpr std::size_t kCallRefusals = static_cast<std::size_t>(CallRefusal::kCount);

// By CallRefusal; kNone stays 0.
using CallRefusalCounts = std::array<std::uint64_t, kCallRefusals>;

// Returns the word for logs, counters and the control plane.
constexpr std::string_view Name(CallRefusal refusal) {
  constexpr std::array<std::string_view, kCallRefusals> kNames = {
      "none",       "unknown_api", "lease",     "parameter",     "state",  "ignored",
      "goal",       "name",        "protected", "not_simulated", "failed", "code",
      "not_served", "undecoded",   "too_many",  "unmatched"};
  return kNames[static_cast<std::size_t>(refusal)];
}

// Returns what that means and what helps, without a full stop; "" for kNone.
constexpr std::string_view Explain(CallRefusal refusal) {
  switch (refusal) {
    case CallRefusal::kUnknownApi:
      return "the service has no such api; docs/reference/services.md lists them";
    case CallRefusal::kLease:
      return "another client holds the service's lease, or the caller's has expired";
    case CallRefusal::kParameter:
      return "its parameter is not JSON, or a field is missing, of another type, out of range or "
             "too long";
    case CallRefusal::kState:
      return "the motion service does not do it in its present state";
    case CallRefusal::kIgnored:
      return "it is accepted and has no effect, as on the real robot in that state";
    case CallRefusal::kGoal:
      return "the motion service has no such state, action or number";
    case CallRefusal::kName:
      return "the robot has nothing of that name";
    case CallRefusal::kProtected:
      return "that program cannot be switched";
    case CallRefusal::kNotSimulated:
      return "it is not simulated";
    case CallRefusal::kFailed:
      return "it was tried and failed";
    case CallRefusal::kCode:
      return "its code tells the reason";
    case CallRefusal::kNotServed:
      return "the program that serves it is off, or no motion service is on";
    case CallRefusal::kUndecoded:
      return "its bytes are not a request; was the program built with the vendor's IDL?";
    case CallRefusal::kTooMany:
      return "more came than the robot can serve, and the oldest were dropped";
    case CallRefusal::kUnmatched:
      return "the writer's type or quality of service does not match the topic";
    case CallRefusal::kNone:
    case CallRefusal::kCount:
      break;
  }
  return {};
}

}  // namespace understudy::services
