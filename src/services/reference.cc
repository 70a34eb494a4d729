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
    "Written by `understudy services > docs/reference/services.md` from the tables of the "
    "services.\n\n"
    "A service `S` takes requests on `rt/api/S/request` and answers on `rt/api/S/response`. A "
    "response repeats the identity of its request. Api 1 returns the version. Parameters are JSON; "
    "if none is needed, `\"\"` and `{}` are the same. A request with `noreply` is carried out "
    "and not answered. A reply waits up to 300 ms for the client's response reader. Requests with "
    "a priority above 0 go first; the queues of a service hold 10 requests, and 5 with priority. "
    "Parameters of more than 16384 bytes and unexpected binary are refused unread. Nobody reads "
    "the requests of a service whose program is off, or that needs a motion service while none is "
    "on. The vendor's Python client then says 3102, and its C++ client times out, 3104.\n\n"
    "Codes of all services: 0 taken, which does not mean that the action succeeds; 3202 internal "
    "failure; 3203 no such api; 3204 bad parameter, unless the service has its own code; 3205 "
    "another client holds the lease. Clients apply for a lease on `rt/api/S_lease/request` (101 "
    "apply, 102 renew); it expires after 1 s unless renewed (3206, 3207).\n\n"
    "No api reports a success that did not happen: one that is not simulated is answered with a "
    "failure and a line in the log.\n\n"
    "Sources: [sdk] a header of unitree_sdk2, commit 21d0a3b; [py] unitree_sdk2_python, commit "
    "37116c5; [docs] the vendor's developer pages; [seen] on a real robot, by others "
    "([sources.md](../dev/sources.md)); assumed. That every service has a lease, and that apis "
    "which only read need none, is assumed.\n\n";

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

std::string ServicesReference() {
  std::string text(kHead);
  text +=
      "A robot's file in [config/robots](../../config/robots) lists its tables under `robot.apis`, "
      "`understudy robots --json` those of all robots; the default is " +
      Joined(robot::RobotSpec{}.apis) +
      ". A table is named after the robot to which the vendor's header belongs; others may have it "
      "too.\n"
      "\nA robot with `uwbswitch` also reads `rt/utlidar/switch` (`ON` or `OFF` for the program "
      "unitree_lidar) and `rt/uwbswitch` (as uwbswitch SwitchSet).\n";
  for (const std::string_view name : kApiNames) text += Section(name, TableNamed(name));
  return text;
}

}  // namespace understudy::services
