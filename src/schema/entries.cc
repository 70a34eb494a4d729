#include "schema/entries.h"

namespace understudy::schema {
namespace {

// Escapes the bar, which would end the cell of a Markdown table.
std::string Cell(std::string_view text) {
  std::string cell;
  for (const char c : text) cell += c == '|' ? std::string("\\|") : std::string(1, c);
  return cell;
}

}  // namespace

std::string Entries::Path(std::string_view key) const {
  const std::string& title = tables_[open_.back()].title;
  return (title.empty() ? "" : title + ".") + std::string(key);
}

void Entries::Visit(const Field& field, const Slot& slot) {
  Entry entry{.key = Path(field.key),
              .type = field.type,
              .unit = std::string(field.unit),
              .does = std::string(field.does),
              .expected = Expected(field),
              .allowed = Allowed(field),
              .usual = ValueText(field, slot),
              .range = field.range,
              .words = {field.words.begin(), field.words.end()}};
  if (field.type == &kSwitch) entry.words = {"false", "true"};
  tables_[open_.back()].entries.push_back(std::move(entry));
}

void Entries::VisitList(const Field& field, const ListSlot& slot) {
  Open(Path(field.key) + "[]", field.does);
  slot.describe_blank();
  Leave();
}

bool Entries::Enter(const Field& field, std::string_view scalar_key) {
  const std::string name(field.key);
  Open(Path(name), field.does);
  if (!scalar_key.empty()) {
    tables_.back().does +=
        "; `" + name + ": WORD` is short for `" + name + "." + std::string(scalar_key) + "`";
  }
  return true;
}

void Entries::Open(const std::string& title, std::string_view does) {
  open_.push_back(tables_.size());
  tables_.push_back({title, std::string(does), {}});
}

std::string Markdown(const std::vector<EntryTable>& tables) {
  std::string text;
  for (const EntryTable& table : tables) {
    if (table.entries.empty()) continue;
    if (!table.title.empty()) text += "## " + table.title + "\n\n" + table.does + ".\n\n";
    text += "| key | unit | allowed | default | meaning |\n|---|---|---|---|---|\n";
    for (const Entry& entry : table.entries) {
      text += "| `" + entry.key + "` | " + Cell(entry.unit) + " | " + Cell(entry.allowed) + " | `" +
              Cell(entry.usual) + "` | " + Cell(entry.does) + " |\n";
    }
    text += "\n";
  }
  return text;
}

}  // namespace understudy::schema
