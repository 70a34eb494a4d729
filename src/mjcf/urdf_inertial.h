// Reads what a link of a URDF weighs, and repairs what no body can have. Private to mjcf/.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "mjcf/document.h"

namespace understudy::mjcf {

// Returns the inertia nearest to `given` [kg·m²] that a body of that mass [kg] can have: its
// principal moments are above 0 and none is more than the sum of the other two. Returns nullopt if
// `given` is such a one. One without a positive moment becomes that of a ball of water.
std::optional<Eigen::Matrix3d> RepairedInertia(const Eigen::Matrix3d& given, double mass);

// Returns a link's <inertial> as MJCF has it; nullopt for a link without mass that does not move.
// One that `moves` gets a gram, and an inertia that no body has is repaired; both add a line to
// `notes`. Throws ModelError, with file and line, for a mass below 0 and for what is no number.
std::optional<MjcfElement> InertialOf(const MjcfElement& link, bool moves,
                                      std::vector<std::string>* notes);

}  // namespace understudy::mjcf
