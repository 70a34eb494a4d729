#include "schema/printer.h"

#include <utility>

namespace understudy::schema {

void Printer::Comment(const std::string& of, const Field& field, const std::string& allowed) {
  if (!with_comments_) return;
  text_ += Indent() + "# " + of + std::string(field.does);
  if (!allowed.empty()) {
    text_ += " [" + (field.unit.empty() ? "" : std::string(field.unit) + "; ") + allowed + "]";
  }
  text_ += "\n";
}

void Printer::Visit(const Field& field, const Slot& slot) {
  const std::string name(field.key);
  switch (mode_) {
    case Mode::kLine:
      Comment("", field, Allowed(field));
      text_ += Indent() + name + ": " + ValueText(field, slot) + "\n";
      return;
    case Mode::kElement:
      element_ += Comma() + name + ": " + ValueText(field, slot);
      return;
    case Mode::kElementComment:
      Comment(name + ": ", field, Allowed(field));
      return;
  }
}

void Printer::VisitList(const Field& field, const ListSlot& slot) {
  switch (mode_) {
    case Mode::kLine:
      Comment("", field, "");
      text_ += Indent() + std::string(field.key) + (slot.size() == 0 ? ": []\n" : ":\n");
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
      element_ += Comma() + std::string(field.key) + ": [" + list + "]";
      return;
    }
    case Mode::kElementComment:
      Comment(std::string(field.key) + ": ", field, "");
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

bool Printer::Enter(const Field& field, std::string_view) {
  if (mode_ == Mode::kElement) {
    element_ += Comma() + std::string(field.key) + ": {";
    return true;
  }
  const bool line = mode_ == Mode::kLine;
  Comment(line ? "" : std::string(field.key) + ": ", field, "");
  if (line) text_ += Indent() + std::string(field.key) + ":\n";
  ++depth_;
  return true;
}

void Printer::Leave() {
  if (mode_ == Mode::kElement) {
    element_ += "}";
  } else {
    --depth_;
  }
}

}  // namespace understudy::schema
