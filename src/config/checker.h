// A condition on a key, told with where the key was set.
#pragma once

#include <string>

#include "base/errors.h"
#include "config/reader.h"

namespace understudy::config {

class Checker {
 public:
  // `places` must outlive the checker.
  explicit Checker(const Places& places) : places_(places) {}

  // Throws ConfigError, "file:line: key: what", unless it fits.
  void Check(bool fits, const std::string& key, const std::string& what) const {
    if (!fits) throw ConfigError(Where(key) + key + ": " + what);
  }

  // "file:line: ", "" where no file and no option set it.
  std::string Where(const std::string& key) const {
    const auto place = places_.find(key);
    return place == places_.end() ? "" : place->second + ": ";
  }

 private:
  const Places& places_;
};

}  // namespace understudy::config
