// Prints the structs that a Describe function lists as YAML that a YamlReader can read back.
#pragma once

#include <string>
#include <string_view>

#include "schema/archive.h"

namespace understudy::schema {

// Prints a list of structs one line per element, including the lists and sections within it. With
// comments, it adds meaning, unit and range above each key, and once above a list for all its
// elements.
class Printer : public Archive {
 public:
  explicit Printer(bool with_comments) : with_comments_(with_comments) {}

  const std::string& text() const { return text_; }

 protected:
  void Visit(const Field& field, const Slot& slot) override;
  void VisitList(const Field& field, const ListSlot& slot) override;
  bool Enter(const Field& field, std::string_view scalar_key) override;
  void Leave() override;

 private:
  // What Visit writes: a line, an entry of a list element's line, or a comment on that entry.
  enum class Mode { kLine, kElement, kElementComment };

  std::string Indent() const { return std::string(2 * depth_, ' '); }
  // What stands before the next entry of a list element's line.
  std::string Comma() const { return element_.empty() || element_.back() == '{' ? "" : ", "; }
  void Comment(const std::string& of, const Field& field, const std::string& allowed);
  std::string Element(const ListSlot& slot, std::size_t i);  // in braces

  bool with_comments_;
  Mode mode_ = Mode::kLine;
  std::size_t depth_ = 0;
  std::string text_;
  std::string element_;
};

}  // namespace understudy::schema
