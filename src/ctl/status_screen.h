// Formats the live screen of `understudy ctl status --watch`.
#pragma once

#include <chrono>
#include <string>

#include <nlohmann/json.hpp>

namespace understudy::ctl {

// Formats successive statuses, with rates.
class StatusScreen {
 public:
  // Formats `status`, the JSON of StatusJson, taken at wall time `now`, which must not go back.
  // Rates are those since the last call, "-" in the first. Throws json::exception for any other
  // JSON.
  std::string Text(const nlohmann::ordered_json& status, std::chrono::nanoseconds now);

 private:
  nlohmann::ordered_json before_;
  std::chrono::nanoseconds then_{0};
};

// Returns `text`, whole lines, with the escape sequences that make it replace a terminal's screen.
std::string OverTheScreen(const std::string& text);

}  // namespace understudy::ctl
