// MJCF files as a tree: includes are put in place and asset files have absolute names, so that the
// tree means the same wherever it stands. Every element knows the file and line it came from.
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

  // The value of an attribute; null where the element has none.
  const std::string* Find(const std::string& attribute) const;
  // The value, or "" where the element has none.
  std::string Get(const std::string& attribute) const;
  void Set(const std::string& attribute, const std::string& value);
  void Drop(const std::string& attribute);
};

// What the <compiler> elements say of an attribute together, "" where they say nothing.
std::string CompilerSays(const MjcfElement& root, const std::string& attribute);

// XML and, for each of its lines, where that line's element came from: lines[0] is line 1.
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

// One line for the start and one for the end of each element.
MjcfText WriteMjcf(const MjcfElement& root);

}  // namespace understudy::mjcf
