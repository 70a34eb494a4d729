#include "services/robot_services.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "base/errors.h"
#include "services/api_names.h"
#include "services/tables/tables.h"

namespace understudy::services {
namespace {

struct NamedTable {
  std::string_view name;
  ServiceTable (*make)();
};

#define UNDERSTUDY_TABLE(name, service, make) {name, [] { return make; }},
constexpr NamedTable kTables[] = {UNDERSTUDY_SERVICE_TABLES(UNDERSTUDY_TABLE)};
#undef UNDERSTUDY_TABLE

}  // namespace

ServiceTable TableNamed(std::string_view name) {
  const auto* found = std::ranges::find(kTables, name, &NamedTable::name);
  if (found == std::end(kTables)) throw std::out_of_range("no api '" + std::string(name) + "'");
  return found->make();
}

std::vector<ServiceTable> ServicesOf(const std::vector<std::string>& apis) {
  std::vector<ServiceTable> tables;
  for (const std::string& api : apis) {
    ServiceTable table = TableNamed(api);
    if (std::ranges::count(tables, table.name, &ServiceTable::name) != 0) {
      throw ConfigError("robot.apis: a robot has only one service '" + std::string(table.name) +
                        "'; '" + api + "' is a second one");
    }
    tables.push_back(std::move(table));
  }
  return tables;
}

}  // namespace understudy::services
