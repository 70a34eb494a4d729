#include "config/profile.h"

#include <algorithm>

#include "base/errors.h"
#include "base/nearest_word.h"

namespace understudy::config {
namespace {

using schema::OneLine;
using schema::ReadYamlFile;
using schema::YamlNames;

using std::filesystem::path;

path Folder(const path& data_dir) { return data_dir / "config" / "profiles"; }

}  // namespace

std::vector<std::string> ProfileNames(const path& data_dir) { return YamlNames(Folder(data_dir)); }

std::string AddProfile(const path& data_dir, std::size_t own, std::vector<YamlValue>* trees) {
  const YamlValue* asked = nullptr;
  std::size_t place = 0;
  for (std::size_t i = 0; i < trees->size(); ++i) {
    const YamlValue* value = (*trees)[i].Find("profile");
    if (value == nullptr) continue;
    asked = value;
    place = i < own ? 0 : own;
  }
  // One that is no word is refused later, when it is read.
  const bool named =
      asked != nullptr && asked->kind == YamlValue::Kind::kScalar && !asked->text.empty();
  std::string name = named ? asked->text : kUsualProfile;
  const std::vector<std::string> names = ProfileNames(data_dir);
  if (std::ranges::find(names, name) == names.end()) {
    if (!named) return {};
    throw ConfigError(asked->where + ": profile: no profile '" + OneLine(name) + "'" +
                      DidYouMean(name, names));
  }
  trees->insert(trees->begin() + static_cast<std::ptrdiff_t>(place),
                ReadYamlFile(Folder(data_dir) / (name + ".yaml")));
  return name;
}

}  // namespace understudy::config
