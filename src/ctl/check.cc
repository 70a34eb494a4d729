#include "ctl/check.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include "base/nearest_word.h"

namespace understudy::ctl {

CLI::Validator NumberWithin(double low, double high) {
  return {[=](std::string& text) -> std::string {
            double value = 0;
            if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high) return {};
            std::ostringstream expected;
            expected << "expected a number from " << low << " to " << high << ", got " << text;
            return expected.str();
          },
          ""};
}

CLI::Validator OneOf(std::vector<std::string> words) {
  return {[words = std::move(words)](std::string& text) -> std::string {
            if (std::find(words.begin(), words.end(), text) != words.end()) return {};
            return "there is no '" + text + "'" + DidYouMean(text, words);
          },
          ""};
}

}  // namespace understudy::ctl
