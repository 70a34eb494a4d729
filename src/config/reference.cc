#include "config/reference.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <string>
#include <vector>

#include "config/keys.h"
#include "emulator/live_settings.h"

namespace understudy::config {
namespace {

std::vector<schema::EntryTable> Tables() {
  schema::Entries entries;
  Config defaults;
  Describe(entries, defaults);
  return entries.tables();
}

bool IsOfRobots(const schema::EntryTable& table) {
  return table.title == "robot" || table.title.starts_with("robot.");
}

// Links to the headings of tables that are in no other one, as GitHub names them.
std::string Contents(const std::vector<schema::EntryTable>& tables) {
  std::string text;
  for (const schema::EntryTable& table : tables) {
    if (table.title.empty() || table.title.find('.') != std::string::npos) continue;
    std::string anchor = table.title;
    std::erase_if(anchor, [](unsigned char c) { return std::isalnum(c) == 0 && c != '_'; });
    text += (text.empty() ? "" : ", ") + ("[" + table.title + "](#" + anchor + ")");
  }
  return text;
}

}  // namespace

std::string ConfigReference() {
  std::vector<schema::EntryTable> of_runs = Tables();
  std::vector<schema::EntryTable> of_robots;
  std::ranges::copy_if(of_runs, std::back_inserter(of_robots), IsOfRobots);
  std::erase_if(of_runs, IsOfRobots);
  return "# Configuration\n\n"
         "Written by `understudy run go2 --help-config > docs/reference/config.md` from the table "
         "of "
         "keys.\n\n"
         "A configuration is YAML of these keys. A run has several, one above the other; of each "
         "key the last value counts:\n"
         "\n"
         "1. the scene, if `scene` is a YAML file\n"
         "2. the robot's file, such as config/robots/go2.yaml, above what it `extends`; then its "
         "revision and hands\n"
         "3. the profile that `profile` names, of config/profiles\n"
         "4. files of `--config`, in their order\n"
         "5. `--set KEY=VALUE`, in their order; `--start`, `--scene` and the other options are "
         "short for keys\n"
         "\n"
         "`understudy run go2 --print-config` prints the result, and `understudy check FILE` "
         "checks a file.\n"
         "\n"
         "Keys of a run: " +
         Contents(of_runs) + ". Those that describe a robot are [below](#of-a-robots-file).\n\n" +
         schema::Markdown(of_runs) +
         "# Of a robot's file\n\nWhat a robot is. A robot of one's own needs them; a run seldom "
         "changes one.\n\n" +
         schema::Markdown(of_robots);
}

std::vector<schema::Entry> ConfigEntries() {
  std::vector<schema::Entry> all;
  for (const schema::EntryTable& table : Tables()) {
    all.insert(all.end(), table.entries.begin(), table.entries.end());
  }
  return all;
}

const std::vector<schema::Entry>& SettingKeys() {
  static const std::vector<schema::Entry> keys = [] {
    const std::vector<schema::Entry> all = ConfigEntries();
    std::vector<schema::Entry> of_live;
    for (const emulator::LiveSetting& live : emulator::LiveSettings()) {
      of_live.push_back(*std::ranges::find(all, live.key, &schema::Entry::key));
    }
    return of_live;
  }();
  return keys;
}

std::vector<std::string> ConfigKeys() {
  std::vector<std::string> keys;
  for (const schema::Entry& entry : ConfigEntries()) keys.push_back(entry.key);
  return keys;
}

std::vector<std::string> WordsOfKey(const std::string& key) {
  for (const schema::Entry& entry : ConfigEntries()) {
    if (entry.key == key) return entry.words;
  }
  return {};
}

}  // namespace understudy::config
