// What checks say of what they found, each in the same words.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <spdlog/fmt/fmt.h>

#include "doctor/checks.h"

namespace understudy::doctor {

// *Assumed*; the periods are those of LowCmd and LowState, 2 ms.
inline constexpr double kLatePeriod = 2e-3;    // s: what comes later meets the next one
inline constexpr double kTenPeriods = 20e-3;   // s: robot and program speak of other instants
inline constexpr std::size_t kMostListed = 4;  // of a kind in one finding

inline constexpr char kNoBus[] = "there is no DDS";
inline constexpr char kNoPeer[] = "no peer was named";
inline constexpr char kOwnFirewall[] =
    "let this machine's firewall pass UDP on this interface, 239.255.0.1 too (nft list ruleset, "
    "iptables -S or ufw status, as root)";

inline Finding Ok(std::string text) { return {.text = std::move(text)}; }
inline Finding Warning(std::string text, std::string remedy) {
  return {.verdict = CheckVerdict::kWarning, .text = std::move(text), .remedy = std::move(remedy)};
}
inline Finding Wrong(std::string text, std::string remedy) {
  return {.verdict = CheckVerdict::kWrong, .text = std::move(text), .remedy = std::move(remedy)};
}
inline Finding NotSeen(std::string text, std::string remedy = "") {
  return {.verdict = CheckVerdict::kNotSeen, .text = std::move(text), .remedy = std::move(remedy)};
}
inline Finding With(Finding finding, Figures figures) {
  finding.figures = std::move(figures);
  return finding;
}

inline std::string Ms(double seconds) { return fmt::format("{:.2f} ms", seconds * 1e3); }

// "A, B, C, D and 3 more".
inline std::string Listed(const std::vector<std::string>& items, const char* between = ", ") {
  std::string text;
  for (std::size_t i = 0; i < std::min(items.size(), kMostListed); ++i) {
    text += (i == 0 ? "" : between) + items[i];
  }
  if (items.size() > kMostListed) text += fmt::format(" and {} more", items.size() - kMostListed);
  return text;
}

inline std::string NoInterface(const Measurements& seen) {
  return "there is no interface '" + seen.question.interface + "'";
}

inline Figures FiguresOf(const DatagramCount& tally) {
  return {{"sent", tally.sent}, {"returned", tally.returned}};
}

inline std::string Counts(const DatagramCount& tally) {
  return fmt::format("{} of {} came back", tally.returned, tally.sent);
}

}  // namespace understudy::doctor
