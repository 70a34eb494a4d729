// Refuses what a key has, with the place where the key was set.
#pragma once

#include <string>

#include "base/errors.h"
#include "schema/yaml_reader.h"

namespace understudy::config {

using schema::Places;

// Checks a condition on a key; the error says where the key was set.
class Checker {
 public:
  // `places` must outlive the checker.
  explicit Checker(const Places& places) : places_(places) {}

  // Throws ConfigError "file:line: key: what" unless `fits`.
  void Check(bool fits, const std::string& key, const std::string& what) const {
    if (!fits) throw ConfigError(Where(key) + key + ": " + what);
  }

  // Returns "file:line: ", "" if the key has its default.
  std::string Where(const std::string& key) const {
    const auto place = places_.find(key);
    return place == places_.end() ? "" : place->second + ": ";
  }

 private:
  const Places& places_;
};

}  // namespace understudy::config
