#include "mjcf/urdf_elements.h"

#include <algorithm>
#include <array>
#include <span>

#include "base/errors.h"
#include "base/printed.h"
#include "mjcf/joints.h"

namespace understudy::mjcf {
namespace {

using Eigen::Vector3d;

}  // namespace

void FailAt(const MjcfElement& element, const std::string& what) {
  throw ModelError(element.place.text() + ": " + what);
}

const MjcfElement* ChildOf(const MjcfElement& element, const std::string& name) {
  const auto child = std::ranges::find(element.children, name, &MjcfElement::name);
  return child == element.children.end() ? nullptr : &*child;
}

std::string NeededIn(const MjcfElement& element, const std::string& attribute) {
  std::string value = element.Get(attribute);
  if (value.empty()) FailAt(element, "<" + element.name + "> has no " + attribute);
  if (value != Printable(value)) {
    FailAt(element,
           attribute + ": expected printable characters, found '" + Printable(value) + "'");
  }
  return value;
}

std::vector<double> NumbersIn(const MjcfElement* element, const std::string& attribute,
                              std::vector<double> otherwise) {
  const std::string* text = element == nullptr ? nullptr : element->Find(attribute);
  if (text == nullptr) return otherwise;
  return ReadNumbers({.attribute = attribute, .value = *text, .place = element->place}, attribute,
                     otherwise.size());
}

double NumberIn(const MjcfElement* element, const std::string& attribute, double otherwise) {
  return NumbersIn(element, attribute, {otherwise})[0];
}

Vector3d VectorIn(const MjcfElement* element, const std::string& attribute,
                  const Vector3d& otherwise) {
  const std::vector<double> n =
      NumbersIn(element, attribute, {otherwise.x(), otherwise.y(), otherwise.z()});
  return {n[0], n[1], n[2]};
}

UrdfOrigin OriginOf(const MjcfElement& element) {
  const MjcfElement* origin = ChildOf(element, "origin");
  const Vector3d rpy = VectorIn(origin, "rpy", Vector3d::Zero());
  return {VectorIn(origin, "xyz", Vector3d::Zero()),
          Eigen::AngleAxisd(rpy.z(), Vector3d::UnitZ()) *
              Eigen::AngleAxisd(rpy.y(), Vector3d::UnitY()) *
              Eigen::AngleAxisd(rpy.x(), Vector3d::UnitX())};
}

std::string TextOf(const Vector3d& v) { return NumbersText(std::span(v.data(), 3)); }
std::string TextOf(double number) { return NumbersText({&number, 1}); }

void SetPlace(const UrdfOrigin& origin, MjcfElement* element) {
  if (!origin.p.isZero(0)) element->Set("pos", TextOf(origin.p));
  const std::array<double, 4> q{origin.r.w(), origin.r.x(), origin.r.y(), origin.r.z()};
  if (!origin.r.vec().isZero(0)) element->Set("quat", NumbersText(q));
}

}  // namespace understudy::mjcf
