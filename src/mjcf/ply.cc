#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <utility>

#include "base/errors.h"
#include "base/printed.h"
#include "mjcf/mesh_builder.h"

namespace understudy::mjcf {
namespace {

enum class Form { kText, kLittle, kBig };

// A kind of number.
struct NumberKind {
  std::string_view name, other_name;
  std::size_t size;
  double (*value)(const char* bytes);  // in the machine's order
};

template <class T>
double ValueOf(const char* bytes) {
  T value{};
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

constexpr NumberKind kNumberKinds[] = {
    {"char", "int8", 1, ValueOf<std::int8_t>},    {"uchar", "uint8", 1, ValueOf<std::uint8_t>},
    {"short", "int16", 2, ValueOf<std::int16_t>}, {"ushort", "uint16", 2, ValueOf<std::uint16_t>},
    {"int", "int32", 4, ValueOf<std::int32_t>},   {"uint", "uint32", 4, ValueOf<std::uint32_t>},
    {"float", "float32", 4, ValueOf<float>},      {"double", "float64", 8, ValueOf<double>},
};

struct PlyProperty {
  std::string name;
  const NumberKind* kind = nullptr;
  const NumberKind* count = nullptr;  // of a list; null: one number
};

struct PlyElement {
  std::string name;
  long count = 0;
  std::vector<PlyProperty> properties;
};

class PlyFile {
 public:
  explicit PlyFile(const std::filesystem::path& file)
      : file_(file.string()), bytes_(MeshBytes(file)), text_(file_, bytes_), parts_(file_) {}

  std::vector<MeshPart> Read() {
    ReadHeader();
    rest_ = text_.rest();
    for (const PlyElement& element : elements_) ReadElement(element);
    if (!has_faces_) {
      throw ModelError(file_ +
                       ": has points and no faces; make a mesh of them first, as with MeshLab or "
                       "open3d's create_from_point_cloud_poisson");
    }
    return parts_.Take();
  }

 private:
  struct Point {
    MeshPoint at{};
    Rgba rgba{0, 0, 0, 1};
  };

  const NumberKind& NumberKindOf(std::string_view name) const {
    const auto* const found = std::ranges::find_if(kNumberKinds, [&](const NumberKind& kind) {
      return kind.name == name || kind.other_name == name;
    });
    if (found == std::end(kNumberKinds)) {
      text_.Fail("expected a kind of number, not '" + Printable(std::string(name)) + "'");
    }
    return *found;
  }

  void ReadHeader() {
    if (!text_.NextLine() || text_.Word() != "ply") text_.Fail("expected 'ply'");
    while (text_.NextLine()) {
      const std::string_view word = text_.Word();
      if (word == "end_header") return;
      if (word == "format") form_ = FormOf(text_.Word());
      if (word == "element") {
        PlyElement& element = elements_.emplace_back();
        element.name = text_.Word();
        element.count = text_.WholeOf(text_.Word());
      }
      if (word == "property") AddProperty();
    }
    text_.Fail("expected 'end_header'");
  }

  Form FormOf(std::string_view word) const {
    constexpr std::pair<std::string_view, Form> kForms[] = {{"ascii", Form::kText},
                                                            {"binary_little_endian", Form::kLittle},
                                                            {"binary_big_endian", Form::kBig}};
    for (const auto& [name, form] : kForms) {
      if (word == name) return form;
    }
    text_.Fail("expected format ascii, binary_little_endian or binary_big_endian, not '" +
               Printable(std::string(word)) + "'");
  }

  void AddProperty() {
    if (elements_.empty()) text_.Fail("a property before the first element");
    PlyProperty property;
    std::string_view word = text_.Word();
    if (word == "list") {
      property.count = &NumberKindOf(text_.Word());
      word = text_.Word();
    }
    property.kind = &NumberKindOf(word);
    property.name = text_.Word();
    elements_.back().properties.push_back(std::move(property));
  }

  void ReadElement(const PlyElement& element) {
    if (element.properties.empty()) return;
    for (long i = 0; i < element.count; ++i) {
      if (element.name == "vertex") points_.emplace_back();
      for (const PlyProperty& property : element.properties) {
        if (property.count != nullptr) {
          ReadList(element, property);
        } else if (const double value = Number(*property.kind); element.name == "vertex") {
          SetPoint(property, value, &points_.back());
        }
      }
    }
  }

  // Returns the next number of the data; each takes a byte at least, so that counts end.
  double Number(const NumberKind& kind) {
    if (form_ == Form::kText) {
      const std::string_view word = text_.AnyWord();
      return text_.NumberOf(word);
    }
    if (rest_.size() < kind.size) throw ModelError(file_ + ": ends too early");
    char bytes[8];
    std::copy_n(rest_.data(), kind.size, bytes);
    static_assert(std::endian::native == std::endian::little);
    if (form_ == Form::kBig) std::reverse(bytes, bytes + kind.size);
    rest_.remove_prefix(kind.size);
    return kind.value(bytes);
  }

  void ReadList(const PlyElement& element, const PlyProperty& property) {
    const double count = Number(*property.count);
    std::vector<std::size_t> corners;
    const bool of_face = element.name == "face" &&
                         (property.name == "vertex_indices" || property.name == "vertex_index");
    for (double i = 0; i < count; ++i) {
      const double number = Number(*property.kind);
      if (!of_face) continue;
      if (!(number >= 0 && number < static_cast<double>(points_.size()))) {
        throw ModelError(file_ + ": no vertex " + Printed("%.0f", number) + ": there are " +
                         std::to_string(points_.size()));
      }
      corners.push_back(static_cast<std::size_t>(number));
    }
    has_faces_ = has_faces_ || of_face;
    for (std::size_t i = 2; i < corners.size(); ++i) {
      const Point &a = points_[corners[0]], &b = points_[corners[i - 1]], &c = points_[corners[i]];
      parts_.Add(painted_ ? std::optional(MeanColour(a.rgba, b.rgba, c.rgba)) : std::nullopt, a.at,
                 b.at, c.at);
    }
  }

  void SetPoint(const PlyProperty& property, double value, Point* point) {
    constexpr std::string_view kAxes[] = {"x", "y", "z"}, kColours[] = {"red", "green", "blue"};
    for (std::size_t i = 0; i < 3; ++i) {
      if (property.name == kAxes[i]) point->at[i] = value;
      if (property.name != kColours[i]) continue;
      painted_ = true;
      // Of a byte, or already from 0 to 1.
      point->rgba[i] = std::clamp(property.kind->size == 1 ? value / 255 : value, 0.0, 1.0);
    }
  }

  std::string file_, bytes_;
  MeshText text_;
  MeshBuilder parts_;
  Form form_ = Form::kText;
  std::vector<PlyElement> elements_;
  std::vector<Point> points_;
  std::string_view rest_;  // of the data, where it is binary
  bool painted_ = false, has_faces_ = false;
};

}  // namespace

std::vector<MeshPart> ReadPly(const std::filesystem::path& file) { return PlyFile(file).Read(); }

}  // namespace understudy::mjcf
