#include "tests/bad_commands/rows.h"

#include <utility>

namespace understudy::bad_commands {

const std::vector<Row>& Rows() {
  static const std::vector<Row> rows = [] {
    std::vector<Row> all;
    for (auto* group : {&ValueRows, &FormRows, &TimeRows, &WriterRows}) {
      for (Row& row : group()) all.push_back(std::move(row));
    }
    return all;
  }();
  return rows;
}

std::string Reference() {
  std::string text =
      "# Bad commands\n\n"
      "Written by the table of `tests/bad_commands`, which does all of it over DDS to every robot, "
      "clamped, and expects what stands here; the next good command is followed then. Throughout, "
      "no motor gives more than its limit, the physics goes well, and `rt/lowstate` goes on with "
      "finite values. The word is that of `understudy ctl status` under which it is counted "
      "(`unmatched` by the "
      "daemon, which looks for such writers, and in its own test, `tests/system/test_log.py`; "
      "`tests/system/test_stopped_program.py` stops and kills programs as processes). "
      "Grades and sources are those of [fidelity.md](fidelity.md).\n\n"
      "Where no robot is named it is all of them; go and hg are the families of messages. Times "
      "are simulated.\n";
  std::string_view group;
  for (const Row& row : Rows()) {
    if (row.group != group) {
      group = row.group;
      text.append("\n## ").append(group).append("\n\n");
      text +=
          "| a program sends | robots | the robot | counted as | grade | source |\n"
          "|---|---|---|---|---|---|\n";
    }
    text.append("| ").append(row.sends).append(" | ").append(row.robots).append(" | ");
    text.append(row.reaction).append(" | ");
    if (!row.counted.empty()) text.append("`").append(row.counted).append("`");
    text.append(" | ").append(row.grade).append(" | ").append(row.source).append(" |\n");
  }
  return text;
}

}  // namespace understudy::bad_commands
