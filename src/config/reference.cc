#include "config/reference.h"

#include <map>
#include <string_view>
#include <variant>

#include "config/archive.h"
#include "config/keys.h"

namespace understudy::config {
namespace {

// Escapes the bar, which would end the cell of a Markdown table.
std::string Cell(std::string_view text) {
  std::string cell;
  for (const char c : text) cell += c == '|' ? std::string("\\|") : std::string(1, c);
  return cell;
}

class ReferenceArchive : public Archive {
 public:
  // The tables, one per section and list, in order of appearance.
  std::string Text() const {
    std::string text;
    for (const Table& table : tables_) {
      if (table.rows.empty()) continue;
      if (!table.title.empty()) text += "## " + table.title + "\n\n" + table.meaning + ".\n\n";
      text += "| key | unit | allowed | default | meaning |\n|---|---|---|---|---|\n";
      text += table.rows + "\n";
    }
    return text;
  }
  const std::vector<std::string>& keys() const { return keys_; }
  const std::map<std::string, std::vector<std::string>>& words() const { return words_; }

 protected:
  void Visit(const Row& row, const Slot& slot) override {
    const std::string key = path_ + std::string(row.name);
    keys_.push_back(key);
    if (std::holds_alternative<bool*>(slot)) words_[key] = {"true", "false"};
    if (const auto* words = std::get_if<WordSlot>(&slot)) words_[key] = words->words;
    tables_[open_.back()].rows += "| `" + key + "` | " + Cell(row.unit) + " | " +
                                  Cell(Allowed(row, slot)) + " | `" + Cell(ValueText(slot)) +
                                  "` | " + Cell(row.meaning) + " |\n";
  }
  void VisitList(const Row& row, const ListSlot& slot) override {
    Open(std::string(row.name) + "[]", row.meaning);
    slot.describe_blank();
    Leave();
  }
  bool Enter(const Row& row, std::string_view scalar_key) override {
    Open(std::string(row.name), row.meaning);
    if (!scalar_key.empty()) {
      const std::string name(row.name);
      tables_.back().meaning +=
          "; `" + name + ": WORD` is short for `" + name + "." + std::string(scalar_key) + "`";
    }
    return true;
  }
  void Leave() override {
    open_.pop_back();
    path_ = tables_[open_.back()].path;
  }

 private:
  struct Table {
    std::string title;
    std::string meaning;
    std::string path;
    std::string rows;
  };

  void Open(const std::string& name, std::string_view meaning) {
    open_.push_back(tables_.size());
    tables_.push_back({path_ + name, std::string(meaning), path_ + name + ".", ""});
    path_ = tables_.back().path;
  }

  std::string path_;
  std::vector<Table> tables_{Table{}};
  std::vector<std::size_t> open_{0};
  std::vector<std::string> keys_;
  std::map<std::string, std::vector<std::string>> words_;  // of those that take words
};

ReferenceArchive Described() {
  ReferenceArchive archive;
  Config defaults;
  Describe(archive, defaults);
  return archive;
}

}  // namespace

std::string ConfigReference() { return Described().Text(); }

std::vector<std::string> ConfigKeys() { return Described().keys(); }

std::vector<std::string> WordsOfKey(const std::string& key) {
  const ReferenceArchive archive = Described();
  const auto found = archive.words().find(key);
  return found == archive.words().end() ? std::vector<std::string>() : found->second;
}

}  // namespace understudy::config
