// Lists the keys of a Describe function with what is known of each, for tables and lists of keys.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "schema/archive.h"

namespace understudy::schema {

struct Entry {
  std::string key;  // dotted; [] stands for the index of a list's element
  const Type* type = nullptr;
  std::string unit;  // "" if there is none
  std::string does;
  std::string expected;  // "a number from 0 to 100 m"
  std::string allowed;   // "0 to 100"
  std::string usual;     // the value of the described struct, as YAML
  Range range;
  std::vector<std::string> words;  // of a switch false, true
};

// The entries of a section or of the elements of a list, in order of appearance.
struct EntryTable {
  std::string title;  // "gate", "robot.motors[]"; "" at the top
  std::string does;
  std::vector<Entry> entries;
};

class Entries : public Archive {
 public:
  const std::vector<EntryTable>& tables() const { return tables_; }

 protected:
  void Visit(const Field& field, const Slot& slot) override;
  void VisitList(const Field& field, const ListSlot& slot) override;
  bool Enter(const Field& field, std::string_view scalar_key) override;
  void Leave() override { open_.pop_back(); }

 private:
  std::string Path(std::string_view key) const;
  void Open(const std::string& title, std::string_view does);

  std::vector<EntryTable> tables_{EntryTable{}};
  std::vector<std::size_t> open_{0};
};

// Returns a Markdown table of each: key, unit, allowed values, default, meaning.
std::string Markdown(const std::vector<EntryTable>& tables);

}  // namespace understudy::schema
