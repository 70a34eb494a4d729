// Reads MJCF files into a tree with includes resolved and absolute names of asset files, so that it
// does not depend on its folder. Each element has its file and line.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace understudy::mjcf {

struct MjcfPlace {
  std::string file;
  int line = 0;

  std::string text() const { return file + ":" + std::to_string(line); }
};

struct MjcfElement {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes;  // in the order of the file
  std::vector<MjcfElement> children;
  MjcfPlace place;

  // Returns the value of an attribute; null if the element has none.
  const std::string* Find(const std::string& attribute) const;
  // Returns the value, or "" if the element has none.
  std::string Get(const std::string& attribute) const;
  void Set(const std::string& attribute, const std::string& value);
  void Drop(const std::string& attribute);
};

// Returns the effective value of an attribute of all <compiler> elements, "" if none has it.
std::string CompilerSays(const MjcfElement& root, const std::string& attribute);

// XML text, and the origin of the element in each line; lines[0] is line 1.
struct MjcfText {
  std::string xml;
  std::vector<MjcfPlace> lines;
};

// Reads a model and what it includes. An include is looked for in the folder of the main file, then
// in that of the file that includes it, as MuJoCo does. Places carry file names as they are reached
// from `file`.
//
// Throws ModelError with file and line when a file of XML is missing, no regular file, not XML, no
// MJCF or included twice, or when the whole is larger than 32 MiB or nested deeper than MuJoCo
// reads.
MjcfElement ReadMjcf(const std::filesystem::path& file);

// Reads other XML the same way, with any root; names of asset files stay as written.
MjcfElement ReadXml(const std::filesystem::path& file);

// One line for the start and one for the end of each element.
MjcfText WriteMjcf(const MjcfElement& root);

}  // namespace understudy::mjcf
