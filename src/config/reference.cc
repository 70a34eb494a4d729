#include "config/reference.h"

#include <algorithm>

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

}  // namespace

std::string ConfigReference() {
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
         "\n" +
         schema::Markdown(Tables());
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
