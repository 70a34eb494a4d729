#include <map>
#include <string>
#include <vector>

#include "robot/robot_spec.h"
#include "services/api_names.h"
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

std::string Joined(const std::vector<std::string>& apis) {
  std::string text;
  for (const std::string& api : apis) text += (text.empty() ? "`" : ", `") + api + "`";
  return text;
}

std::string Section(std::string_view name, const ServiceTable& table) {
  std::string text = "\n## " + std::string(table.title) + "\n\n";
  text += "`" + std::string(name) + "` of `robot.apis`. Topic `rt/api/" + std::string(table.name) +
          "`, api version " + std::string(table.api_version) + ".";
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

std::string ServicesReference(const std::map<std::string, std::vector<std::string>>& robots) {
  std::string text(kHead);
  text += "A robot's file names what it has under `robot.apis`; without that it has " +
          Joined(robot::RobotSpec{}.apis) + ".\n\n| robot | `apis` |\n|---|---|\n";
  for (const auto& [robot, apis] : robots) text += "| " + robot + " | " + Joined(apis) + " |\n";
  text +=
      "\nA robot with `uwbswitch` also listens to `rt/utlidar/switch` (`ON`, `OFF`: the program "
      "unitree_lidar) and to `rt/uwbswitch` (what uwbswitch SwitchSet sets).\n";
  for (const std::string_view name : kApiNames) text += Section(name, TableNamed(name));
  return text;
}

}  // namespace understudy::services
