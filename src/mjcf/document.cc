#include "mjcf/document.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <map>
#include <system_error>

#include <tinyxml2.h>

#include "base/errors.h"
#include "mjcf/assets.h"

namespace understudy::mjcf {
namespace {

using std::filesystem::path;

// The largest of the vendor's models has 0.2 MiB of XML.
constexpr std::uintmax_t kMostBytes = 32U << 20U;
// MuJoCo's own reader, tinyxml2, stops at 100.
constexpr int kMostLevels = 99;

constexpr std::size_t kMostFiles = 1000;

class Reader {
 public:
  explicit Reader(const path& file) : folder_(file.parent_path()) {}

  MjcfElement ReadFile(const path& file, const std::string& asked_by, int level) {
    const std::string name = file.string();
    std::error_code error;
    const path canonical = std::filesystem::weakly_canonical(file, error);
    const auto [first, is_new] = seen_.try_emplace(canonical.string(), asked_by);
    if (!is_new) {
      throw ModelError(asked_by + ": " + name + " is included a second time" +
                       (first->second.empty() ? "" : "; the first time at " + first->second));
    }
    if (seen_.size() > kMostFiles) {
      throw ModelError(asked_by + ": more than " + std::to_string(kMostFiles) + " files");
    }
    tinyxml2::XMLDocument document;
    const std::string text = ReadText(file, asked_by);
    if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
      const int line = document.ErrorLineNum();
      throw ModelError(name + (line > 0 ? ":" + std::to_string(line) : "") +
                       ": is not XML: " + ErrorText(document));
    }
    const tinyxml2::XMLElement* root = document.RootElement();
    if (root == nullptr) throw ModelError(name + ": holds no element; expected <mujoco>");
    return Convert(*root, file, level);
  }

 private:
  static std::string ErrorText(const tinyxml2::XMLDocument& document) {
    switch (document.ErrorID()) {
      case tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED:
        return "nested too deep";
      case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
        return "it is empty";
      case tinyxml2::XML_ERROR_PARSING_TEXT:
        return "text where an element should be";
      case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
        return "expected name=\"value\"";
      case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
        return "an element is not closed";
      default:
        return tinyxml2::XMLDocument::ErrorIDToName(document.ErrorID());
    }
  }

  std::string ReadText(const path& file, const std::string& asked_by) {
    const std::string place = (asked_by.empty() ? "" : asked_by + ": ") + file.string();
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) {
      throw ModelError(place + (std::filesystem::is_directory(file, error) ? ": is a folder"
                                                                           : ": no such file"));
    }
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (error || size > kMostBytes - bytes_) {
      throw ModelError(place + ": too large; a model and its includes may have 32 MiB of XML");
    }
    bytes_ += size;
    std::string text(size, '\0');
    std::ifstream stream(file, std::ios::binary);
    if (!stream.read(text.data(), static_cast<std::streamsize>(size))) {
      throw ModelError(place + ": cannot be read");
    }
    return text;
  }

  MjcfElement Convert(const tinyxml2::XMLElement& element, const path& file, int level) {
    MjcfElement result;
    result.name = element.Name();
    result.place = {file.string(), element.GetLineNum()};
    if (level > kMostLevels) {
      throw ModelError(result.place.text() + ": <" + result.name + "> is nested deeper than the " +
                       std::to_string(kMostLevels) + " levels MuJoCo reads");
    }
    for (const auto* a = element.FirstAttribute(); a != nullptr; a = a->Next()) {
      result.attributes.emplace_back(a->Name(), a->Value());
    }
    for (const auto* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      if (std::string(child->Name()) == "include") {
        Include(*child, file, level, &result.children);
      } else {
        result.children.push_back(Convert(*child, file, level + 1));
      }
    }
    return result;
  }

  // Appends the elements of the included file.
  void Include(const tinyxml2::XMLElement& include, const path& file, int level,
               std::vector<MjcfElement>* siblings) {
    const std::string place = MjcfPlace{file.string(), include.GetLineNum()}.text();
    const char* name = include.Attribute("file");
    if (name == nullptr || *name == '\0') throw ModelError(place + ": <include> names no file");
    std::error_code error;
    path included = folder_ / name;
    if (!std::filesystem::exists(included, error)) {
      const path beside = file.parent_path() / name;
      if (std::filesystem::exists(beside, error)) included = beside;
    }
    MjcfElement root = ReadFile(included, place, level);
    std::move(root.children.begin(), root.children.end(), std::back_inserter(*siblings));
  }

  path folder_;                              // of the main file
  std::map<std::string, std::string> seen_;  // file, where it was included
  std::uintmax_t bytes_ = 0;
};

std::string Escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\n':
      case '\r':
      case '\t':
        escaped += ' ';  // one line per element
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

void Write(const MjcfElement& element, MjcfText* text) {
  text->xml += '<' + element.name;
  for (const auto& [name, value] : element.attributes) {
    text->xml += ' ' + name + "=\"" + Escaped(value) + '"';
  }
  text->xml += element.children.empty() ? "/>\n" : ">\n";
  text->lines.push_back(element.place);
  if (element.children.empty()) return;
  for (const MjcfElement& child : element.children) Write(child, text);
  text->xml += "</" + element.name + ">\n";
  text->lines.push_back(element.place);
}

}  // namespace

const std::string* MjcfElement::Find(const std::string& attribute) const {
  for (const auto& [key, value] : attributes) {
    if (key == attribute) return &value;
  }
  return nullptr;
}

std::string MjcfElement::Get(const std::string& attribute) const {
  const std::string* value = Find(attribute);
  return value == nullptr ? "" : *value;
}

void MjcfElement::Set(const std::string& attribute, const std::string& value) {
  for (auto& [key, old] : attributes) {
    if (key == attribute) {
      old = value;
      return;
    }
  }
  attributes.emplace_back(attribute, value);
}

void MjcfElement::Drop(const std::string& attribute) {
  std::erase_if(attributes, [&](const auto& entry) { return entry.first == attribute; });
}

std::string CompilerSays(const MjcfElement& root, const std::string& attribute) {
  std::string value;
  for (const MjcfElement& section : root.children) {
    const std::string* said = section.name == "compiler" ? section.Find(attribute) : nullptr;
    if (said != nullptr) value = *said;
  }
  return value;
}

MjcfElement ReadXml(const std::filesystem::path& file) {
  return Reader(file).ReadFile(file, "", 1);
}

MjcfElement ReadMjcf(const std::filesystem::path& file) {
  MjcfElement root = ReadXml(file);
  if (root.name != "mujoco") {
    throw ModelError(root.place.text() + ": expected MJCF, whose root is <mujoco>; got <" +
                     root.name + ">");
  }
  MakeAssetsAbsolute(&root, file.parent_path());
  return root;
}

MjcfText WriteMjcf(const MjcfElement& root) {
  MjcfText text;
  Write(root, &text);
  return text;
}

}  // namespace understudy::mjcf
