#include "figure.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

namespace understudy::bench {

bool Figure::Met() const {
  if (!bound) return true;
  return wanted == Wanted::kAtLeast ? value >= *bound : value <= *bound;
}

double Median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

double Percentile(std::vector<double> values, double p) {
  std::ranges::sort(values);
  const double rank = std::ceil(p * static_cast<double>(values.size()));
  return values[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

std::string Table(const std::vector<Figure>& figures) {
  std::string table;
  const auto add = [&table](const char* robot, const char* name, const char* value,
                            const char* unit, const char* wanted, const char* met) {
    char row[200];
    std::snprintf(row, sizeof(row), "%-6s %-46s %10s %-8s %-12s %s\n", robot, name, value, unit,
                  wanted, met);
    table += row;
  };
  add("robot", "figure", "measured", "unit", "wanted", "");
  for (const Figure& figure : figures) {
    char value[32], bound[32] = "";
    std::snprintf(value, sizeof(value), "%.5g", figure.value);
    if (figure.bound) {
      std::snprintf(bound, sizeof(bound), "%s %.4g",
                    figure.wanted == Wanted::kAtLeast ? ">=" : "<=", *figure.bound);
    }
    add(figure.robot.c_str(), figure.name.c_str(), value, figure.unit.c_str(), bound,
        !figure.bound  ? ""
        : figure.Met() ? "met"
                       : "missed");
  }
  return table;
}

std::string Json(const std::vector<Figure>& figures) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const Figure& figure : figures) {
    nlohmann::ordered_json row = {{"robot", figure.robot},
                                  {"name", figure.name},
                                  {"unit", figure.unit},
                                  {"measured", figure.value}};
    if (figure.bound) {
      row[figure.wanted == Wanted::kAtLeast ? "at_least" : "at_most"] = *figure.bound;
      row["met"] = figure.Met();
    }
    rows.push_back(row);
  }
  return nlohmann::ordered_json{{"figures", rows}}.dump() + "\n";
}

}  // namespace understudy::bench
