// Collects triangles by colour, and reads the text of mesh files.
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mjcf/mesh_file.h"

namespace understudy::mjcf {

using Rgba = std::array<double, 4>;
using MeshPoint = std::array<double, 3>;

// Throws ModelError where ReadMeshFile does.
class MeshBuilder {
 public:
  explicit MeshBuilder(std::string file) : file_(std::move(file)) {}

  void Add(const std::optional<Rgba>& rgba, const MeshPoint& a, const MeshPoint& b,
           const MeshPoint& c);
  // The parts in the order of their colours. Throws if there is no triangle.
  std::vector<MeshPart> Take();

 private:
  std::string file_;
  std::map<std::optional<Rgba>, std::vector<float>> parts_;
  std::size_t triangles_ = 0;
};

// Returns the bytes of a file. Throws ModelError.
std::string MeshBytes(const std::filesystem::path& file);

// Words of a text, parted by blanks, and the line on which they stand.
class MeshText {
 public:
  MeshText(std::string file, std::string_view text) : file_(std::move(file)), rest_(text) {}

  // Goes to the next line; false at the end.
  bool NextLine();
  // Returns the next word of the line; "" if there is none.
  std::string_view Word();
  // Returns the next word of all lines; "" at the end.
  std::string_view AnyWord();
  // Throws ModelError if the next word of the line is none.
  double Number() { return NumberOf(Word()); }
  double NumberOf(std::string_view word) const;
  long WholeOf(std::string_view word) const;
  [[noreturn]] void Fail(const std::string& what) const;
  std::string_view rest() const { return rest_; }  // after the line

 private:
  std::string file_;
  std::string_view rest_, line_;
  int number_ = 0;
};

// The colour of a triangle by those of its corners, rounded to eighths.
Rgba MeanColour(const Rgba& a, const Rgba& b, const Rgba& c);

}  // namespace understudy::mjcf
