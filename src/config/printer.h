// Writes the structs that a Describe function lists as YAML that a Reader reads back.
#pragma once

#include <string>
#include <string_view>

#include "config/archive.h"

namespace understudy::config {

// Lists of structs get one line per element, lists within an element and all. With comments,
// meaning, unit and range stand above each key, and above a list once for all its elements.
class Printer : public Archive {
 public:
  explicit Printer(bool with_comments) : with_comments_(with_comments) {}

  const std::string& text() const { return text_; }

 protected:
  void Visit(const Row& row, const Slot& slot) override;
  void VisitList(const Row& row, const ListSlot& slot) override;
  bool Enter(const Row& row, std::string_view scalar_key) override;
  void Leave() override { --depth_; }

 private:
  // What Visit writes: a line of its own, an entry of the element's line, or a comment on it.
  enum class Mode { kLine, kElement, kElementComment };

  std::string Indent() const { return std::string(2 * depth_, ' '); }
  void Comment(const Row& row, const std::string& allowed);
  std::string Element(const ListSlot& slot, std::size_t i);  // in braces

  bool with_comments_;
  Mode mode_ = Mode::kLine;
  std::size_t depth_ = 0;
  std::string text_;
  std::string element_;
};

}  // namespace understudy::config
