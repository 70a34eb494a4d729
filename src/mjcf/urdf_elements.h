// Reads elements of URDF: children, attributes, numbers, places. Private to mjcf/.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "mjcf/document.h"

namespace understudy::mjcf {

// Throws ModelError with the file and line of the element.
[[noreturn]] void FailAt(const MjcfElement& element, const std::string& what);

// Returns the first child of that name, null if there is none.
const MjcfElement* ChildOf(const MjcfElement& element, const std::string& name);

// Returns an attribute; throws ModelError if it is missing or empty.
std::string NeededIn(const MjcfElement& element, const std::string& attribute);

// Return the numbers of an attribute; `otherwise` if the element or the attribute is missing. Throw
// ModelError for what are no numbers, or not so many.
std::vector<double> NumbersIn(const MjcfElement* element, const std::string& attribute,
                              std::vector<double> otherwise);
double NumberIn(const MjcfElement* element, const std::string& attribute, double otherwise);
Eigen::Vector3d VectorIn(const MjcfElement* element, const std::string& attribute,
                         const Eigen::Vector3d& otherwise);

struct UrdfOrigin {
  Eigen::Vector3d p{0, 0, 0};
  Eigen::Quaterniond r{1, 0, 0, 0};
};

// Returns what <origin> says of the place of an element, in the frame in which it stands.
UrdfOrigin OriginOf(const MjcfElement& element);

// Returns numbers as MJCF has them.
std::string TextOf(const Eigen::Vector3d& v);
std::string TextOf(double number);

// Gives an element of MJCF its place.
void SetPlace(const UrdfOrigin& origin, MjcfElement* element);

}  // namespace understudy::mjcf
