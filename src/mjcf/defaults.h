// Looks up attributes of a model's elements, including those of default classes.
#pragma once

#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mjcf/document.h"

namespace understudy::mjcf {

// A setting and the element that has it: the element itself or a default.
struct MjcfSetting {
  std::string attribute;
  std::string value;
  MjcfPlace place;
};

// The default classes of a tree. Valid while no element of the tree is added or removed.
class MjcfDefaults {
 public:
  // Throws ModelError if a nested default has no class name or a duplicate one.
  explicit MjcfDefaults(const MjcfElement& root);

  // Returns the first of the attributes that the element has, else that of the nearest class, else
  // nullopt. `class_name` is the element's class ("" for the topmost one); `kinds` are the elements
  // of a class that set its defaults. An unknown class counts as the topmost one.
  std::optional<MjcfSetting> Find(const MjcfElement& element, const std::string& class_name,
                                  std::span<const char* const> kinds,
                                  std::initializer_list<const char*> attributes) const;

 private:
  struct Class {
    std::string parent;  // "" for the topmost one, whose own key is "" too
    std::vector<const MjcfElement*> settings;
  };

  void Collect(const MjcfElement& element, const std::string& name, const std::string& parent);

  std::map<std::string, Class> classes_;
};

}  // namespace understudy::mjcf
