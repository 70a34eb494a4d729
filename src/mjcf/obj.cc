#include <cstddef>
#include <map>

#include "base/printed.h"
#include "mjcf/mesh_builder.h"

namespace understudy::mjcf {
namespace {

using Colours = std::map<std::string, Rgba, std::less<>>;

// Materials of a file beside the mesh; none if it is not there.
void ReadMaterials(const std::filesystem::path& file, Colours* colours) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return;
  const std::string bytes = MeshBytes(file);
  MeshText text(file.string(), bytes);
  std::string name;
  while (text.NextLine()) {
    const std::string_view word = text.Word();
    if (word == "newmtl") name = text.Word();
    if (word == "Kd") {
      const double r = text.Number(), g = text.Number(), b = text.Number();
      (*colours)[name] = {r, g, b, 1};
    }
  }
}

class ObjFile {
 public:
  explicit ObjFile(const std::filesystem::path& file)
      : file_(file), bytes_(MeshBytes(file)), text_(file.string(), bytes_), parts_(file.string()) {}

  std::vector<MeshPart> Read() {
    while (text_.NextLine()) {
      const std::string_view word = text_.Word();
      if (word == "v") AddPoint();
      if (word == "f") AddPolygon();
      if (word == "usemtl") UseMaterial(text_.Word());
      // A path would be that of another computer.
      if (word == "mtllib") {
        const std::filesystem::path named(text_.Word());
        ReadMaterials(file_.parent_path() / named.filename(), &colours_);
      }
    }
    return parts_.Take();
  }

 private:
  struct Point {
    MeshPoint at;
    std::optional<Rgba> rgba;
  };

  void AddPoint() {
    Point point{{text_.Number(), text_.Number(), text_.Number()}, std::nullopt};
    // Three more are a colour, one is a weight.
    const std::string_view r = text_.Word(), g = text_.Word(), b = text_.Word();
    if (!b.empty()) point.rgba = {text_.NumberOf(r), text_.NumberOf(g), text_.NumberOf(b), 1};
    points_.push_back(point);
  }

  // "7", "7/1", "7//3" or "-1", which is the last so far.
  const Point& PointOf(std::string_view word) const {
    const long number = text_.WholeOf(word.substr(0, word.find('/')));
    const auto count = static_cast<long>(points_.size());
    const long place = number < 0 ? count + number : number - 1;
    if (place < 0 || place >= count) {
      text_.Fail("no vertex " + std::to_string(number) + ": there are " + std::to_string(count));
    }
    return points_[static_cast<std::size_t>(place)];
  }

  void AddPolygon() {
    std::vector<const Point*> corners;
    for (std::string_view w = text_.Word(); !w.empty(); w = text_.Word()) {
      corners.push_back(&PointOf(w));
    }
    if (corners.size() < 3) text_.Fail("expected three corners or more");
    for (std::size_t i = 2; i < corners.size(); ++i) {
      const Point &a = *corners[0], &b = *corners[i - 1], &c = *corners[i];
      const bool painted = a.rgba && b.rgba && c.rgba;
      parts_.Add(painted ? MeanColour(*a.rgba, *b.rgba, *c.rgba) : material_, a.at, b.at, c.at);
    }
  }

  void UseMaterial(std::string_view name) {
    const auto found = colours_.find(name);
    material_ = found == colours_.end() ? std::nullopt : std::optional(found->second);
  }

  std::filesystem::path file_;
  std::string bytes_;
  MeshText text_;
  MeshBuilder parts_;
  std::vector<Point> points_;
  Colours colours_;
  std::optional<Rgba> material_;
};

}  // namespace

std::vector<MeshPart> ReadObj(const std::filesystem::path& file) { return ObjFile(file).Read(); }

}  // namespace understudy::mjcf
