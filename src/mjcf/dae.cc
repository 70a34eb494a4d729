#include "mjcf/dae.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <map>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

#include <Eigen/Geometry>
#include <tinyxml2.h>

#include "base/errors.h"
#include "base/printed.h"
#include "mjcf/mesh_builder.h"

namespace understudy::mjcf {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using tinyxml2::XMLElement;

constexpr std::uintmax_t kMostDaeBytes = 64U << 20U;
constexpr std::size_t kMostCorners = 9 * 4'000'000;  // numbers, of all parts
constexpr int kMostNodeLevels = 50;                  // of nodes
constexpr double kFarthest = 1e6;                    // m
constexpr std::size_t kMostNodes = 100'000;          // as often as they are named
constexpr std::size_t kMostNumbers = 100'000'000;    // as often as they are read
constexpr std::size_t kMostParts = 32;               // further colours count as the last
std::string_view Attribute(const XMLElement& element, const char* name) {
  const char* const value = element.Attribute(name);
  return value == nullptr ? "" : value;
}

std::string_view Content(const XMLElement* element) {
  const char* const text = element == nullptr ? nullptr : element->GetText();
  return text == nullptr ? "" : text;
}

// Returns null if any element on the way is missing.
const XMLElement* Down(const XMLElement* from, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (from == nullptr) return nullptr;
    from = from->FirstChildElement(name);
  }
  return from;
}

template <class F>
void ForEach(const XMLElement& parent, const char* name, F f) {
  for (const XMLElement* e = parent.FirstChildElement(name); e != nullptr;
       e = e->NextSiblingElement(name)) {
    f(*e);
  }
}

class DaeFile {
 public:
  explicit DaeFile(const std::filesystem::path& file) : file_(file.string()) {
    std::error_code error;
    if (std::filesystem::file_size(file, error) > kMostDaeBytes || error) {
      throw ModelError(file_ + ": expected a file of at most 64 MiB");
    }
    if (document_.LoadFile(file.c_str()) != tinyxml2::XML_SUCCESS) {
      throw ModelError(file_ + ":" + std::to_string(document_.ErrorLineNum()) + ": not XML");
    }
    root_ = document_.RootElement();
    if (root_ == nullptr) throw ModelError(file_ + ": expected COLLADA, found no element");
    if (std::strcmp(root_->Name(), "COLLADA") != 0) {
      Fail(*root_, "expected COLLADA, not <" + Printable(root_->Name()) + ">");
    }
    Collect(*root_);
  }

  std::vector<MeshPart> Read() {
    const XMLElement* scene = Down(root_, {"scene", "instance_visual_scene"});
    scene = scene == nullptr ? Down(root_, {"library_visual_scenes", "visual_scene"})
                             : &Named(*scene, Attribute(*scene, "url"));
    if (scene == nullptr) Fail(*root_, "expected a <visual_scene>");
    const Affine3d metres(Eigen::Scaling(Unit()));
    ForEach(*scene, "node", [&](const XMLElement& node) { AddNode(node, metres, 1); });
    if (parts_.empty()) Fail(*scene, "expected triangles");
    return std::move(parts_);
  }

 private:
  [[noreturn]] void Fail(const XMLElement& element, const std::string& what) const {
    throw ModelError(file_ + ":" + std::to_string(element.GetLineNum()) + ": " + what);
  }

  void Collect(const XMLElement& element) {
    if (const std::string_view id = Attribute(element, "id"); !id.empty()) {
      by_id_.emplace(id, &element);
    }
    for (const XMLElement* e = element.FirstChildElement(); e; e = e->NextSiblingElement()) {
      Collect(*e);
    }
  }

  // The element that a reference "#id" of `by` is to.
  const XMLElement& Named(const XMLElement& by, std::string_view reference) const {
    const auto found = by_id_.find(reference.substr(reference.starts_with('#') ? 1 : 0));
    if (found == by_id_.end()) {
      Fail(by, "nothing has the id '" + Printable(std::string(reference)) + "'");
    }
    return *found->second;
  }

  template <class T>
  std::vector<T> Numbers(const XMLElement& element) {
    const std::string_view text = Content(&element);
    std::vector<T> numbers;
    for (const char *at = text.data(), *end = at + text.size();;) {
      at = std::find_if(at, end, [](unsigned char c) { return std::isspace(c) == 0; });
      if (at == end) return numbers;
      T number{};
      const auto [next, error] = std::from_chars(at, end, number);
      bool good = error == std::errc() && (next == end || std::isspace(*next & 0xff) != 0);
      if constexpr (std::is_floating_point_v<T>) good = good && std::isfinite(number);
      if (!good) Fail(element, "<" + Printable(element.Name()) + ">: expected numbers");
      numbers.push_back(number);
      if (++numbers_ > kMostNumbers) Fail(element, "more than 100 million numbers");
      at = next;
    }
  }

  std::vector<double> Numbers(const XMLElement& element, std::size_t count) {
    std::vector<double> numbers = Numbers<double>(element);
    if (numbers.size() != count) {
      Fail(element, "expected " + std::to_string(count) + " numbers");
    }
    return numbers;
  }

  // The file's unit of length, m.
  double Unit() const {
    const XMLElement* const unit = Down(root_, {"asset", "unit"});
    const double metre = unit == nullptr ? 1 : unit->DoubleAttribute("meter", 1);
    if (!(metre > 0 && metre < 1e6)) Fail(*unit, "meter: expected a length above 0");
    return metre;
  }

  Affine3d Place(const XMLElement& node) {
    Affine3d place = Affine3d::Identity();
    for (const XMLElement* e = node.FirstChildElement(); e; e = e->NextSiblingElement()) {
      const std::string_view name = e->Name();
      if (name == "matrix") {
        const std::vector<double> n = Numbers(*e, 16);
        Affine3d own;
        own.matrix() = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(n.data());
        place = place * own;
      } else if (name == "translate" || name == "scale") {
        const std::vector<double> n = Numbers(*e, 3);
        const Eigen::Map<const Vector3d> v(n.data());
        if (name == "scale") {
          place.scale(v);
        } else {
          place.translate(v);
        }
      } else if (name == "rotate") {
        const std::vector<double> n = Numbers(*e, 4);
        const Vector3d axis(n[0], n[1], n[2]);
        if (axis.norm() > 0) {
          place.rotate(Eigen::AngleAxisd(n[3] * std::numbers::pi / 180, axis.normalized()));
        }
      }
    }
    return place;
  }

  void AddNode(const XMLElement& node, const Affine3d& parent, int level) {
    if (level > kMostNodeLevels) Fail(node, "more than 50 levels of nodes");
    if (++nodes_ > kMostNodes) Fail(node, "more than 100000 nodes");
    const Affine3d place = parent * Place(node);
    ForEach(node, "instance_geometry", [&](const XMLElement& one) { AddGeometry(one, place); });
    ForEach(node, "node", [&](const XMLElement& one) { AddNode(one, place, level + 1); });
    ForEach(node, "instance_node", [&](const XMLElement& one) {
      AddNode(Named(one, Attribute(one, "url")), place, level + 1);
    });
  }

  void AddGeometry(const XMLElement& instance, const Affine3d& place) {
    const XMLElement& geometry = Named(instance, Attribute(instance, "url"));
    const XMLElement* const mesh = geometry.FirstChildElement("mesh");
    if (mesh == nullptr) return;  // a curve
    for (const char* name : {"tristrips", "trifans"}) {
      if (const XMLElement* const other = mesh->FirstChildElement(name)) {
        Fail(*other, "<" + std::string(name) + ">: expected triangles, polylist or polygons");
      }
    }
    for (const char* name : {"triangles", "polylist", "polygons"}) {
      ForEach(*mesh, name, [&](const XMLElement& faces) {
        AddFaces(faces, place, &PartOf(ColourOf(instance, Attribute(faces, "material"))));
      });
    }
  }

  // The colour that an instance of a geometry gives to a name of a material.
  std::optional<Rgba> ColourOf(const XMLElement& instance, std::string_view symbol) {
    const XMLElement* binding = Down(&instance, {"bind_material", "technique_common"});
    if (binding != nullptr) binding = binding->FirstChildElement("instance_material");
    while (binding != nullptr && Attribute(*binding, "symbol") != symbol) {
      binding = binding->NextSiblingElement("instance_material");
    }
    if (binding == nullptr) return std::nullopt;
    const XMLElement* const of =
        Down(&Named(*binding, Attribute(*binding, "target")), {"instance_effect"});
    if (of == nullptr) return std::nullopt;
    const XMLElement* const technique =
        Down(&Named(*of, Attribute(*of, "url")), {"profile_COMMON", "technique"});
    for (const char* shading : {"phong", "lambert", "blinn"}) {
      const XMLElement* const colour = Down(technique, {shading, "diffuse", "color"});
      if (colour == nullptr) continue;
      std::vector<double> n = Numbers(*colour, 4);
      for (double& part : n) part = std::clamp(part, 0.0, 1.0);
      return Rgba{n[0], n[1], n[2], 1};  // what a file says of transparency is mostly wrong
    }
    return std::nullopt;
  }

  MeshPart& PartOf(const std::optional<Rgba>& rgba) {
    const auto found = std::ranges::find(parts_, rgba, &MeshPart::rgba);
    if (found != parts_.end()) return *found;
    if (parts_.size() == kMostParts) return parts_.back();
    return parts_.emplace_back(MeshPart{rgba, {}});
  }

  // The numbers of a source's array, and how many of them make a point.
  struct Points {
    std::vector<double> numbers;
    std::size_t stride = 3;
  };

  Points PositionsOf(const XMLElement& input) {
    const XMLElement& vertices = Named(input, Attribute(input, "source"));
    const XMLElement* position = vertices.FirstChildElement("input");
    while (position != nullptr && Attribute(*position, "semantic") != "POSITION") {
      position = position->NextSiblingElement("input");
    }
    if (position == nullptr) Fail(vertices, "expected an input POSITION");
    const XMLElement& source = Named(*position, Attribute(*position, "source"));
    const XMLElement* const array = source.FirstChildElement("float_array");
    if (array == nullptr) Fail(source, "expected a <float_array>");
    const XMLElement* const accessor = Down(&source, {"technique_common", "accessor"});
    const unsigned stride = accessor == nullptr ? 3 : accessor->UnsignedAttribute("stride", 3);
    if (stride < 3 || stride > 100) Fail(*accessor, "stride: expected 3 or more");
    return {Numbers<double>(*array), stride};
  }

  void AddFaces(const XMLElement& faces, const Affine3d& place, MeshPart* part) {
    std::size_t offset = 0, inputs = 1;
    const XMLElement* vertex = nullptr;
    ForEach(faces, "input", [&](const XMLElement& input) {
      const std::size_t at = input.UnsignedAttribute("offset", 0);
      if (at > 100) Fail(input, "offset: expected less than 100");
      inputs = std::max(inputs, at + 1);
      if (Attribute(input, "semantic") == "VERTEX") {
        vertex = &input;
        offset = at;
      }
    });
    if (vertex == nullptr) Fail(faces, "expected an input VERTEX");
    const Points points = PositionsOf(*vertex);
    const bool mirrored = place.linear().determinant() < 0;
    ForEach(faces, "p", [&](const XMLElement& p) {
      const auto indices = Numbers<std::size_t>(p);
      std::vector<Vector3d> corners;
      for (std::size_t i = offset; i < indices.size(); i += inputs) {
        const std::size_t at = indices[i];
        if (at >= points.numbers.size() / points.stride) {
          Fail(p, "vertex " + std::to_string(at) + ": there are " +
                      std::to_string(points.numbers.size() / points.stride));
        }
        const Vector3d& corner = corners.emplace_back(
            place * Eigen::Map<const Vector3d>(points.numbers.data() + at * points.stride));
        if (!corner.allFinite() || corner.norm() > kFarthest) Fail(p, "a vertex beyond 1000 km");
      }
      for (std::size_t first = 0; const std::size_t count : SizesOf(faces, corners.size())) {
        if (count > corners.size() - first) Fail(p, "fewer corners than its faces need");
        AddPolygon(faces, {corners.data() + first, count}, mirrored, part);
        first += count;
      }
    });
  }

  // How many of the corners each face has, in turn.
  std::vector<std::size_t> SizesOf(const XMLElement& faces, std::size_t corners) {
    const std::string_view kind = faces.Name();
    if (kind == "polygons") return {corners};
    if (kind == "triangles") return std::vector<std::size_t>(corners / 3, 3);
    const XMLElement* const sizes = faces.FirstChildElement("vcount");
    if (sizes == nullptr) Fail(faces, "expected a <vcount>");
    return Numbers<std::size_t>(*sizes);
  }

  // As a fan, which is right for convex ones.
  void AddPolygon(const XMLElement& faces, std::span<const Vector3d> corners, bool mirrored,
                  MeshPart* part) {
    for (std::size_t i = 2; i < corners.size(); ++i) {
      corners_ += 9;
      if (corners_ > kMostCorners) Fail(faces, "more than 4 million triangles");
      for (const std::size_t corner :
           {std::size_t{0}, mirrored ? i : i - 1, mirrored ? i - 1 : i}) {
        for (const double x : corners[corner]) part->corners.push_back(static_cast<float>(x));
      }
    }
  }

  std::string file_;
  tinyxml2::XMLDocument document_;
  const XMLElement* root_ = nullptr;
  std::map<std::string_view, const XMLElement*> by_id_;
  std::vector<MeshPart> parts_;
  std::size_t corners_ = 0;
  std::size_t nodes_ = 0;
  std::size_t numbers_ = 0;
};

}  // namespace

std::vector<MeshPart> ReadDae(const std::filesystem::path& file) { return DaeFile(file).Read(); }

}  // namespace understudy::mjcf
