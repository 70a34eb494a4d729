// Draws the live screen of `understudy ctl status --watch`.
#pragma once

#include <chrono>
#include <string>

#include <nlohmann/json.hpp>

namespace understudy::ctl {

// Turns one status after another into text.
class Watch {
 public:
  // `status` is what StatusJson yields, taken at `now`, which only has to grow. Rates are those
  // since the status before, "-" for the first. Throws json::exception for another shape.
  std::string Text(const nlohmann::ordered_json& status, std::chrono::nanoseconds now);

 private:
  nlohmann::ordered_json before_;
  std::chrono::nanoseconds then_{0};
};

// `text`, of whole lines, in place of what is on a terminal's screen.
std::string OverTheScreen(const std::string& text);

}  // namespace understudy::ctl
