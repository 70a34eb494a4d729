// Arrays of JSON.
#pragma once

#include <functional>

#include <nlohmann/json.hpp>

namespace understudy::server {

// An array of what `tell` makes of each.
template <class Values, class Tell>
nlohmann::ordered_json List(const Values& values, Tell tell) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& value : values) list.push_back(std::invoke(tell, value));
  return list;
}

}  // namespace understudy::server
