#include "config/printer.h"

#include <utility>

namespace understudy::config {

void Printer::Comment(const Row& row, const std::string& allowed) {
  if (!with_comments_) return;
  text_ += Indent() + "# " + std::string(row.meaning);
  if (!allowed.empty()) {
    text_ += " [" + (row.unit.empty() ? "" : std::string(row.unit) + "; ") + allowed + "]";
  }
  text_ += "\n";
}

void Printer::Visit(const Row& row, const Slot& slot) {
  const std::string name(row.name);
  switch (mode_) {
    case Mode::kLine:
      Comment(row, Allowed(row, slot));
      text_ += Indent() + name + ": " + ValueText(slot) + "\n";
      return;
    case Mode::kElement:
      element_ += (element_.empty() ? "" : ", ") + name + ": " + ValueText(slot);
      return;
    case Mode::kElementComment:
      Comment(Row("", {row.unit, row.range, name + ": " + std::string(row.meaning)}),
              Allowed(row, slot));
      return;
  }
}

void Printer::VisitList(const Row& row, const ListSlot& slot) {
  switch (mode_) {
    case Mode::kLine:
      Comment(row, "");
      text_ += Indent() + std::string(row.name) + (slot.size() == 0 ? ": []\n" : ":\n");
      ++depth_;
      if (with_comments_) {
        mode_ = Mode::kElementComment;
        slot.describe_blank();
      }
      mode_ = Mode::kElement;
      for (std::size_t i = 0; i < slot.size(); ++i) {
        text_ += Indent() + "- " + Element(slot, i) + "\n";
      }
      mode_ = Mode::kLine;
      --depth_;
      return;
    case Mode::kElement: {
      std::string list;
      for (std::size_t i = 0; i < slot.size(); ++i) {
        list += (list.empty() ? "" : ", ") + Element(slot, i);
      }
      element_ += (element_.empty() ? "" : ", ") + std::string(row.name) + ": [" + list + "]";
      return;
    }
    case Mode::kElementComment:
      Comment(Row("", About(std::string(row.name) + ": " + std::string(row.meaning))), "");
      ++depth_;
      slot.describe_blank();
      --depth_;
      return;
  }
}

std::string Printer::Element(const ListSlot& slot, std::size_t i) {
  std::string around = std::exchange(element_, "");
  slot.describe(i);
  return "{" + std::exchange(element_, std::move(around)) + "}";
}

bool Printer::Enter(const Row& row, std::string_view) {
  Comment(row, "");
  text_ += Indent() + std::string(row.name) + ":\n";
  ++depth_;
  return true;
}

}  // namespace understudy::config
