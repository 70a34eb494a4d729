#include "ctl/check.h"

#include <sstream>

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

}  // namespace understudy::ctl
