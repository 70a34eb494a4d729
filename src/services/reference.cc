#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "services/parameter.h"
#include "services/robot_services.h"

namespace understudy::services {
namespace {

constexpr std::string_view kHead =
    "# Services\n\n"
    "Written by `understudy services > docs/services.md` from the tables that answer.\n\n"
    "A service `S` takes requests on `rt/api/S/request` and answers on `rt/api/S/response`. The "
    "identity of a request is echoed. Api 1 answers the version of the api. Parameters are JSON; "
    "where none is needed, `\"\"` and `{}` are the same. A request with `noreply` is carried out "
    "and not answered. A reply waits up to 300 ms for the response reader of who asked. Requests "
    "with a priority above 0 go first; of a service, 10 and 5 with priority wait. Parameters of "
    "more than 16384 bytes and unexpected binary are refused unread. While a service's program is "
    "off, and for motion while no motion service is on, nothing answers and clients time out "
    "(3104).\n\n"
    "Codes of all services: 0 taken, which does not promise that it ends well; 3202 it failed "
    "inside; 3203 no such api; 3204 bad parameter, unless the service has its own code; 3205 "
    "another client holds the lease. A lease is asked for on `rt/api/S_lease/request` (101 apply, "
    "102 renew) and is over after 1 s unless renewed (3206, 3207).\n\n"
    "Nothing claims a success that did not happen: what a robot can do and nothing here can is "
    "answered with a failure and a line in the log.\n\n"
    "Sources: [sdk] a header of unitree_sdk2, commit 21d0a3b; [py] unitree_sdk2_python, commit "
    "37116c5; [docs] the vendor's developer pages; [seen] on a real robot by others; assumed. That "
    "every service has a lease and that only reading needs none is assumed.\n\n";

std::string Titles(const std::vector<ServiceTable>& tables) {
  std::string text;
  for (const ServiceTable& table : tables) {
    text += (text.empty() ? "" : "; ") + std::string(table.title);
  }
  return text;
}

std::string Section(const ServiceTable& table) {
  std::string text = "\n## " + std::string(table.title) + "\n\n";
  text += "Topic `rt/api/" + std::string(table.name) + "`, api version " +
          std::string(table.api_version) + ".";
  if (!table.program.empty()) text += " Served by `" + std::string(table.program) + "`.";
  if (table.needs_motion) text += " Answers while a motion service is on.";
  if (!table.note.empty()) text += " " + std::string(table.note);
  text += "\n\n| api | name | parameter | does | source |\n|---|---|---|---|---|\n";
  std::map<std::int64_t, const ApiRow*> rows;
  for (const ApiRow& row : table.rows) rows[row.id] = &row;
  for (const auto& [id, row] : rows) {
    text += "| " + std::to_string(id) + " | " + std::string(row->name) + " | " +
            DescribeFields(row->fields) + " | " + std::string(row->does);
    if (std::holds_alternative<NoController>(row->effect)) {
      text += ": " + std::to_string(row->unable_code.value_or(table.codes.unable));
    }
    text += " | " + std::string(row->source) + " |\n";
  }
  return text;
}

}  // namespace

std::string ServicesReference() {
  std::string text(kHead);
  text += "| robot | services |\n|---|---|\n";
  std::vector<ServiceTable> all;
  for (const std::string_view robot : RobotsWithServices()) {
    const std::vector<ServiceTable> tables = ServicesOf(robot);
    text += "| " + std::string(robot) + " | " + Titles(tables) + " |\n";
    for (const ServiceTable& table : tables) {
      if (std::ranges::find(all, table.title, &ServiceTable::title) == all.end()) {
        all.push_back(table);
      }
    }
  }
  text += "| any other | " + Titles(ServicesOf("")) + " |\n\n";
  text +=
      "A Go2 also listens to `rt/utlidar/switch` (`ON`, `OFF`: the program unitree_lidar) and to "
      "`rt/uwbswitch` (what uwbswitch SwitchSet sets).\n";
  for (const ServiceTable& table : all) text += Section(table);
  return text;
}

}  // namespace understudy::services
