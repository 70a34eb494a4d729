// Finds what an element of a model has, its default classes included.
#pragma once

#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mjcf/document.h"

namespace understudy::mjcf {

// A setting and the element that makes it, itself or a default.
struct MjcfSetting {
  std::string attribute;
  std::string value;
  MjcfPlace place;
};

// Holds pointers into the tree it was made from: valid while no element is added or removed.
class MjcfDefaults {
 public:
  // Throws ModelError when a nested default has no class name or one that another has.
  explicit MjcfDefaults(const MjcfElement& root);

  // The first of the attributes that the element has, else the nearest class, else nothing.
  // `class_name` is the class the element takes ("" for the topmost one); `kinds` are the elements
  // of a class that set defaults for it. A class that is not there counts as the topmost one.
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
