// The checks of `understudy doctor`: each a law over what was seen.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "doctor/measurements.h"

namespace understudy::doctor {

enum class CheckVerdict { kOk, kWarning, kWrong, kNotSeen };

// Returns "ok", "warning", "wrong" or "not seen".
std::string_view Word(CheckVerdict verdict);

using Figures = std::vector<std::pair<std::string_view, double>>;  // by name, SI

struct Finding {
  CheckVerdict verdict = CheckVerdict::kOk;
  std::string text{};    // what was found, with figures and units
  std::string remedy{};  // what to do; "" where there is nothing to do
  Figures figures{};     // for programs
};

struct Check {
  std::string_view name;      // unique
  std::string_view looks_at;  // one clause, for people
  Finding (*judge)(const Measurements& evidence);
};

// All of them, in the order in which they are shown: a cause stands before what follows from it.
std::span<const Check> Checks();
// Their groups, in that order: the interface, the domain, another machine, this machine.
std::span<const Check> NetworkChecks();
std::span<const Check> DomainChecks();
std::span<const Check> PeerChecks();
std::span<const Check> MachineChecks();

}  // namespace understudy::doctor
