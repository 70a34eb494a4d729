#include "config/setting_keys.h"

#include <cassert>
#include <map>
#include <string>

#include "config/archive.h"
#include "config/keys.h"
#include "emulator/live_settings.h"

namespace understudy::config {
namespace {

// Collects the keys of single numbers, switches and words.
class Collector : public Archive {
 public:
  std::map<std::string, emulator::SettingKey, std::less<>> keys;

 protected:
  void Visit(const Row& row, const Slot& slot) override {
    emulator::SettingKey key{.key = path_ + std::string(row.name),
                             .unit = std::string(row.unit),
                             .does = std::string(row.meaning),
                             .expected = Expected(row, slot),
                             .low = row.range.min,
                             .high = row.range.max};
    if (std::holds_alternative<bool*>(slot)) key.words = {"false", "true"};
    if (const auto* words = std::get_if<WordSlot>(&slot)) key.words = words->words;
    keys.emplace(key.key, key);
  }
  void VisitList(const Row&, const ListSlot&) override {}
  bool Enter(const Row& row, std::string_view) override {
    path_ += std::string(row.name) + ".";
    return true;
  }
  void Leave() override { path_.resize(path_.rfind('.', path_.size() - 2) + 1); }

 private:
  std::string path_;
};

}  // namespace

std::vector<emulator::SettingKey> SettingKeys() {
  Collector collector;
  Config defaults;
  Describe(collector, defaults);
  std::vector<emulator::SettingKey> keys;
  for (const emulator::LiveSetting& live : emulator::LiveSettings()) {
    const auto key = collector.keys.find(live.key);
    assert(key != collector.keys.end());
    keys.push_back(key->second);
  }
  return keys;
}

}  // namespace understudy::config
