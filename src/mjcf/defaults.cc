#include "mjcf/defaults.h"

#include <algorithm>

#include "base/errors.h"

namespace understudy::mjcf {

MjcfDefaults::MjcfDefaults(const MjcfElement& root) {
  classes_[""];
  for (const MjcfElement& section : root.children) {
    // Every top-level section belongs to the topmost class, under any name.
    if (section.name == "default") Collect(section, "", "");
  }
}

void MjcfDefaults::Collect(const MjcfElement& element, const std::string& name,
                           const std::string& parent) {
  Class& own = classes_[name];
  own.parent = parent;
  for (const MjcfElement& child : element.children) {
    if (child.name == "default") {
      const std::string nested = child.Get("class");
      if (classes_.contains(nested)) {  // the topmost one is there already, as ""
        throw ModelError(child.place.text() + ": <default> needs a class name of its own, got '" +
                         nested + "'");
      }
      Collect(child, nested, name);
    } else {
      own.settings.push_back(&child);
    }
  }
}

std::optional<MjcfSetting> MjcfDefaults::Find(const MjcfElement& element,
                                              const std::string& class_name,
                                              std::span<const char* const> kinds,
                                              std::initializer_list<const char*> attributes) const {
  for (const char* attribute : attributes) {
    if (const std::string* value = element.Find(attribute)) {
      return MjcfSetting{attribute, *value, element.place};
    }
  }
  auto found = classes_.find(class_name);
  if (found == classes_.end()) found = classes_.find("");
  while (true) {
    const Class& own = found->second;
    for (auto setting = own.settings.rbegin(); setting != own.settings.rend(); ++setting) {
      const bool fits = std::any_of(kinds.begin(), kinds.end(),
                                    [&](const char* kind) { return (*setting)->name == kind; });
      if (!fits) continue;
      for (const char* attribute : attributes) {
        if (const std::string* value = (*setting)->Find(attribute)) {
          return MjcfSetting{attribute, *value, (*setting)->place};
        }
      }
    }
    if (found->first.empty()) return std::nullopt;
    found = classes_.find(own.parent);
  }
}

}  // namespace understudy::mjcf
